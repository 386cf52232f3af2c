// SPDX-License-Identifier: MIT
// A sweep of one scene: draws the reference and every row, times the rows in turn and keeps them.
#pragma once

#include "compare/experiment/references.h"
#include "compare/experiment/sweep.h"
#include "compare/external/renderer_file.h"
#include "compare/render/reference_frame.h"
#include "compare/tradeoff/sweep_state.h"
#include "compare/tradeoff/tradeoff.h"
#include "shared/scene/scene_view.h"
#include "shared/vulkan/device/device.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace diptych::tradeoff {

// The inputs of a sweep.
struct SweepQuestion {
    std::string scene;
    std::vector<std::string> cameras;
    Settings settings;
    experiment::SweepRows rows;
    bool only_sensitive = true;  // omit rows that differ in nothing the scene is sensitive to
    RenderOptions drawing;       // `runs`: timed frames of each row
    ImageChoice image;
    std::filesystem::path folder;                                                    // of the output
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();  // of SweepCost
};

class Sweep {
public:
    // Reads the scene, draws the reference and opens the kept rows. `device` and the progress of `stage`
    // must outlive the object.
    Sweep(SweepQuestion question, Device& device, const Stage& stage);

    const Tradeoff& tradeoff() const { return tradeoff_; }
    const std::vector<Settings>& rows() const { return question_.rows.rows; }
    bool isRenewed() const { return state_.isRenewed(); }  // rows of another key were removed
    const ReferenceCheckpoints& referenceCheckpoints() const { return reference_checkpoints_; }

    // Draws and times the rows. `shown`: called with a row's index after its first timing block.
    void draw(const std::function<void(std::size_t)>& shown);

    // Adds a row for each external renderer, over all cameras. Returns the errors of those that failed.
    std::vector<SceneError> drawExternally(std::span<const external::ExternalRenderer> renderers,
                                           const std::function<void(std::size_t)>& shown);

    // Writes the folder, removes what was kept and returns tradeoff.json.
    std::string write(bool force);

private:
    SceneViews& sensitiveViews();  // omits insensitive rows
    experiment::ReferenceFrames drawReferences();
    nlohmann::ordered_json key() const;
    void drawRows(const Stage& stage, const std::function<void(std::size_t)>& shown);
    void timeAgain(const Stage& stage);
    double referenced() const;  // fraction of the progress at which the reference is drawn

    SweepQuestion question_;
    Device& device_;
    const Stage stage_;
    Tradeoff tradeoff_;
    const double loaded_;  // fraction of the progress at which the scene is loaded
    const Scene scene_;
    SceneViews views_;
    Renderer renderer_;
    experiment::PreparedPool pool_;
    ReferenceCheckpoints reference_checkpoints_;
    const experiment::ReferenceFrames references_;
    SweepState state_;
};

}  // namespace diptych::tradeoff
