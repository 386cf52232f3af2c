// SPDX-License-Identifier: MIT
// The reference's Frame: compare/reference and what the tool gives it.
#pragma once

#include "compare/render/render_options.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// What of Settings the truth depends on, with path = reference; the rest is as usual.
Settings referenceSettings(const Settings& settings);

// What a path is told: no Setting of the reference alone.
Settings withoutReference(const Settings& settings);

// What mode surface shades: forward+, one sample, with nothing packed.
Settings surfaceSettings(const Settings& settings);

// A Frame of our reference: drawn now, or read from a file that we wrote. Another renderer's file is none.
bool isReferenceFrame(const Frame& frame);

// `view` is the one that the Settings ask for. `surfaces` is the Frame of surfaceSettings() with
// reference::surfaceChannels(); nullptr in mode scene.
Frame drawReferenceFrame(const Scene& scene, const SceneView& view, const Settings& settings,
                         const Frame* surfaces, const RenderOptions& options);

// Where references keep what is done of them until a command ends: beside its output, one file each. They are
// gone on from when the same command is given again.
class KeptReferences {
public:
    // The folders above an output that is one itself are made, as they are for it.
    KeptReferences(std::filesystem::path output, bool isFolder)
        : output_(std::move(output)), is_folder_(isFolder) {}
    std::filesystem::path next();  // for one reference more, in the command's order
    void remove();                 // the command has made its output

private:
    std::filesystem::path output_;
    bool is_folder_;
    std::vector<std::filesystem::path> files_;
};

}  // namespace diptych
