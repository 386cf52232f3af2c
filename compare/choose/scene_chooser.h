// SPDX-License-Identifier: MIT
// Chooses Settings on one device: reads scenes, draws references, measures candidates.
#pragma once

#include "compare/choose/joint.h"
#include "compare/choose/report.h"
#include "compare/experiment/references.h"
#include "compare/run/progress.h"
#include "shared/vulkan/device/device.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::choose {

// The budget and the candidates that `choose` asks for.
struct Question {
    Settings settings;
    std::vector<std::string> cameras;  // empty: all of the scene
    std::string grid;                  // a file or JSON; empty: defaultGrids()
    Budget budget;
    bool explain = false;  // also report scene properties that decide between the paths
    RenderOptions drawing;
    ImageChoice image;
};

// The measure of an error metric. Throws std::runtime_error if --metric names none.
Measure metricNamed(const std::string& name);

class SceneChooser {
public:
    // The arguments must outlive the object.
    SceneChooser(const Question& question, Device& device, Progress& progress);
    ~SceneChooser();

    ChoiceReport choose(const std::string& scene);
    // One Settings for all scenes; call choose() for each first. Only one scene is in memory: others are
    // read again, but their references are kept.
    JointReport chooseJointly(const std::vector<ChoiceReport>& reports);

private:
    struct LoadedScene;  // a scene, read and uploaded
    LoadedScene& load(const std::string& scene, const Stage& progress);
    // `requested`: Settings that candidates change.
    SettingsChoice search(LoadedScene& loaded, const Settings& requested,
                          const std::vector<Settings>& candidates, const Stage& progress) const;
    // A candidate's words, and a command for all cameras and maybe other scenes.
    void describe(AnyReport& report, Settings& candidate, const std::string& scene) const;
    HeldOutCamera atHeldOut(LoadedScene& loaded, const Settings& truth, const ChoiceReport& report,
                            const std::string& camera);
    std::optional<SensitivityReport> sensitivityOf(LoadedScene& loaded, const ChoiceReport& report,
                                                   const Stage& progress);

    const Question& question_;
    Progress& progress_;
    Device& device_;
    std::shared_ptr<PipelineSet> pipelines_;
    std::map<std::string, experiment::ReferenceFrames> references_;  // key: scene
    std::unique_ptr<LoadedScene> loaded_;
};

}  // namespace diptych::choose
