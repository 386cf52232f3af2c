// SPDX-License-Identifier: MIT
// Workload of a frame on any device: vertices, triangles, fragments, texels, lights and bytes.
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"
#include "shared/vulkan/device/device.h"
#include "shared/vulkan/passes/pass_list.h"

#include <vector>

namespace diptych {

struct PassWork {
    PassCounts counts;
    double texels = 0;        // filtered samples of material textures
    double lights = 0;        // light evaluations at fragments
    double vertex_bytes = 0;  // read by vertex shaders; counts each vertex once per invocation
};

struct FrameWork {
    Path path = Path::deferred;
    std::vector<PassWork> passes;
};

// Renders each frame twice and counts the passes of the second. Textures are an average over the materials
// of visible triangles; lights are an average over the light lists of pixels that show a surface. Throws
// std::runtime_error if the device cannot count.
std::vector<FrameWork> countWork(Device& device, SceneViews& views, const std::vector<Settings>& settings);

}  // namespace diptych
