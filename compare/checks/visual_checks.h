// SPDX-License-Identifier: MIT
// Visual checks: places where both paths may be wrong in the same way, which no comparison of the two can
// show, so that a person must look.
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

// One feature of the scene at one place. Its names come from the scene's file and are not escaped.
struct VisualCheck {
    std::string what;   // one sentence: what is seen there if it is right
    std::string name;   // short, of the place
    std::string where;  // material, mesh and node
    PixelBox box;       // around what is seen of it; never empty
    std::uint64_t pixels = 0;
};

// The checks of one feature, largest first.
struct FeatureChecks {
    std::string_view feature;
    std::uint64_t found = 0;  // in view; at most `checksShown` of them are listed
    std::vector<VisualCheck> checks;
};
inline constexpr std::size_t checksShown = 24;

// One check for each feature of an instance that the view shows. The instance's bounds, cut off at the near
// and far planes, are projected; of that box the pixels count at which `materials`, the channel material_id,
// has the instance's material and `positions`, the channel position, lies within its bounds: without any such
// pixel the instance is hidden, outside the picture or turned away. A channel that is nullptr is not
// consulted. Features without a check are left out.
std::vector<FeatureChecks> visualChecksOf(const Scene& scene, const Pose& pose, const View& view,
                                          const Image* materials, const Image* positions);

// The same with the channels of a Frame that was drawn of this view.
std::vector<FeatureChecks> visualChecksOf(const Scene& scene, const SceneView& view, const Frame& frame);

}  // namespace diptych
