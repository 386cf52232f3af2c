// SPDX-License-Identifier: MIT
// Makes a Frame with the reference renderer (compare/reference).
#pragma once

#include "compare/frames/render_options.h"
#include "compare/reference/checkpoint.h"
#include "compare/reference/reference.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace diptych {

// `view`: the view of the Settings. `surfaces`: the Frame of surfaceSettings() with
// reference::surfaceChannels(); nullptr in mode scene. `decoded`: the same for deferred, for
// Frame::through_gbuffer; may be nullptr.
Frame drawReferenceFrame(const Scene& scene, const SceneView& view, const Settings& settings,
                         const Frame* surfaces, const RenderOptions& options, const Frame* decoded = nullptr);

// One pixel of that Frame and each light's contribution, by reference::drawPixel().
reference::PixelLight drawReferencePixel(const Scene& scene, const SceneView& view, const Settings& settings,
                                         const Frame* surfaces, int x, int y);

// Whether these Settings need a Vulkan device: all do except the reference in mode scene, which finds its
// surfaces itself.
bool needsDevice(const Settings& settings);

// One Frame per Settings, in order; needsDevice() must be false for all. Without views it makes its own.
std::vector<Frame> drawWithoutDevice(SceneViews& views, const std::vector<Settings>& settings,
                                     const RenderOptions& options);
std::vector<Frame> drawWithoutDevice(const Scene& scene, const std::vector<Settings>& settings,
                                     const RenderOptions& options);

// Checkpoints of references until a command ends: one file each beside its output, named after the image
// (.NAME.reference-HASH). The same command resumes from them. Programs with different outputs have
// separate files.
class ReferenceCheckpoints {
public:
    // Creates the parent folders of an output that is a folder, as is done for the output itself.
    ReferenceCheckpoints(const std::filesystem::path& output, bool isFolder);

    // Opens a checkpoint for one more reference; lives as long as this object. Throws std::runtime_error
    // naming the file if it cannot be written.
    reference::Checkpoint& open(std::uint64_t key, std::size_t floats);
    // The same for RenderOptions::keep.
    auto opener() {
        return [this](std::uint64_t key, std::size_t floats) -> reference::Checkpoint& {
            return open(key, floats);
        };
    }

    void remove();  // call when the output is complete

    // A line for the user about checkpoints left by other commands with the same output, which nothing
    // else removes; empty if there are none.
    std::string leftByOthers() const;

private:
    std::filesystem::path stem_;
    bool is_folder_;
    std::vector<std::unique_ptr<reference::Checkpoint>> checkpoints_;
};

}  // namespace diptych
