// SPDX-License-Identifier: MIT
#pragma once

#include "shared/draw/culling.h"
#include "shared/frame/settings.h"
#include "shared/scene/scene_view.h"
#include "shared/vulkan/device/device.h"

#include <string>
#include <vector>

namespace diptych {

// Features that the view's scene needs and features that are omitted, each with its reason. The default
// light of an unlit scene does not count as the scene's. `settings` choose the skinning method, shadows,
// haze, and the cost of layers and transmission.
std::vector<Requirements::Line> planLines(const SceneView& view, const Settings& settings);

// Bytes of images per pixel, for a number of samples.
struct SampledBytes {
    int samples = 1;
    std::uint32_t geometry = 0;  // PixelBytes
    std::uint32_t all = 0;
};

// The passes of a frame and their sizes, found without rendering it.
struct PathPlan {
    std::string path;
    std::vector<std::string> passes;
    std::vector<SampledBytes> bytes;           // first as planned, then with other sample counts
    std::uint64_t shared_bytes_per_pixel = 0;  // saved by images that share memory
    DrawnCounts drawn;
    std::vector<std::string> notes;
};
std::vector<PathPlan> planPaths(Device& device, SceneViews& views, const std::vector<Settings>& settings);

}  // namespace diptych
