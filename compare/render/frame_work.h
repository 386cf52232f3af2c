// SPDX-License-Identifier: MIT
// What a frame asks of a device, whichever it is: vertices, triangles, fragments, texels, lights and bytes.
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"
#include "shared/vulkan/device.h"
#include "shared/vulkan/pass_list.h"

#include <vector>

namespace diptych {

struct PassWork {
    PassCounts counts;
    double texels = 0;        // filtered samples of material textures
    double lights = 0;        // evaluations of a light at a fragment
    double vertex_bytes = 0;  // read by vertex shaders, each vertex once a shading
};

struct FrameWork {
    Path path = Path::deferred;
    std::vector<PassWork> passes;
};

// Draws each frame twice, the second time with its passes counted. Textures are those of the materials of the
// triangles in view, on average; lights those of the lists, on average over the pixels that show a surface.
// Throws std::runtime_error where the device cannot count.
std::vector<FrameWork> countWork(Device& device, SceneViews& views, const std::vector<Settings>& settings);

}  // namespace diptych
