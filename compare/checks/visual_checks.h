// SPDX-License-Identifier: MIT
// Visual inspection: features that both paths may render wrongly in the same way. A comparison of the
// paths cannot find such errors, so a person must look.
#pragma once

#include "compare/checks/pixel_box.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/scene_view.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

struct Pose;
struct Scene;
struct SceneView;
struct View;

// One feature at one location. Names come from the scene's file and are not escaped.
struct VisualCheck {
    std::string what;   // one sentence: the correct image
    std::string name;   // short name of the location
    std::string where;  // material, mesh and node
    PixelBox box;       // around its visible pixels; never empty
    std::uint64_t pixels = 0;
};

// Inspections of one feature, largest first.
struct FeatureChecks {
    std::string_view feature;
    std::uint64_t found = 0;  // in view; lists at most maxChecks of them
    std::vector<VisualCheck> checks;
};
inline constexpr std::size_t maxChecks = 24;

// One inspection per feature of a visible instance. Projects the instance's bounds, clipped at the near
// and far planes, to a pixel box. Counts pixels in the box with the instance's material in `materials`
// (channel material_id) and a position in its bounds in `positions` (channel position). Without such
// pixels the instance is hidden, outside the image, or facing away. A null channel is ignored. Omits
// features without inspections.
std::vector<FeatureChecks> visualChecksOf(const Scene& scene, const Pose& pose, const View& view,
                                          const Image* materials, const Image* positions);

// The same with the channels of a Frame of this view.
std::vector<FeatureChecks> visualChecksOf(const Scene& scene, const SceneView& view, const Frame& frame);

}  // namespace diptych
