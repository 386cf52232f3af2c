// SPDX-License-Identifier: MIT
// Makes a Frame with the reference renderer of compare/reference.
#pragma once

#include "compare/reference/checkpoint.h"
#include "compare/reference/reference.h"
#include "compare/render/render_options.h"
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

// `view` is the one that the Settings ask for. `surfaces` is the Frame of surfaceSettings() with
// reference::surfaceChannels(); nullptr in mode scene. `decoded`: the same of deferred, for
// Frame::through_gbuffer; or nullptr.
Frame drawReferenceFrame(const Scene& scene, const SceneView& view, const Settings& settings,
                         const Frame* surfaces, const RenderOptions& options, const Frame* decoded = nullptr);

// One pixel of that Frame and what each light adds to it, as reference::drawPixel() has it.
reference::PixelLight drawReferencePixel(const Scene& scene, const SceneView& view, const Settings& settings,
                                         const Frame* surfaces, int x, int y);

// Whether a Frame of these Settings is drawn with a Vulkan device: all but the reference of mode scene, which
// makes its surfaces itself.
bool needsDevice(const Settings& settings);

// One Frame per Settings, in order, none of which needsDevice(). Without views it has its own of the scene.
std::vector<Frame> drawWithoutDevice(SceneViews& views, const std::vector<Settings>& settings,
                                     const RenderOptions& options);
std::vector<Frame> drawWithoutDevice(const Scene& scene, const std::vector<Settings>& settings,
                                     const RenderOptions& options);

// Where references keep what is done of them until a command ends: beside its output, one file each, named
// after the picture (.NAME.reference-HASH). They are gone on from when the same command is given again.
// Programs with one output each have their own files.
class KeptReferences {
public:
    // The folders above an output that is one itself are made, as they are for it.
    KeptReferences(const std::filesystem::path& output, bool isFolder);

    // For one reference more. As reference::Request::keep; lives as long as this does. Throws
    // std::runtime_error naming the file where it cannot be written.
    reference::Checkpoint& open(std::uint64_t key, std::size_t floats);

    void remove();  // the command has made its output

    // A line for the user on what other commands with the same output have left, which nothing else would
    // ever remove; empty where there is nothing.
    std::string leftByOthers() const;

private:
    std::filesystem::path stem_;
    bool is_folder_;
    std::vector<std::unique_ptr<reference::Checkpoint>> checkpoints_;
};

}  // namespace diptych
