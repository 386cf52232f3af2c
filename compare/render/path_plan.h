// SPDX-License-Identifier: MIT
#pragma once

#include "shared/draw/culling.h"
#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"
#include "shared/vulkan/device.h"

#include <string>
#include <vector>

namespace diptych {

// What the scene of a view needs modelled and what is left out, each with its reason in words. The sun that
// the tool adds to an unlit scene is not the scene's; what poses vertices, shadows and haze are chosen by
// `settings`.
std::vector<Requirements::Line> planLines(const SceneView& view, const Settings& settings);

// What a pixel takes in images, with so many samples.
struct SampledBytes {
    int samples = 1;
    std::uint32_t geometry = 0;  // PixelBytes
    std::uint32_t all = 0;
};

// The passes of a frame and their sizes, found without drawing it.
struct PathPlan {
    std::string path;
    std::vector<std::string> passes;
    std::vector<SampledBytes> bytes;  // first as planned, then with other numbers of samples a pixel
    std::uint64_t shared_bytes_per_pixel =
        0;  // saved where images that are never needed together share memory
    DrawnCounts drawn;
    std::vector<std::string> notes;
};
std::vector<PathPlan> planPaths(Device& device, SceneViews& views, const std::vector<Settings>& settings);

}  // namespace diptych
