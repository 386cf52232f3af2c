// SPDX-License-Identifier: MIT
// Where both paths may be wrong alike, so that no comparison of the two can show it and a person has to look.
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

// One feature of the scene at one place. The names in it are the file's: nobody has escaped them.
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
    std::uint64_t found = 0;  // in view, of which at most `checksShown` are told
    std::vector<VisualCheck> checks;
};
inline constexpr std::size_t checksShown = 24;

// One check for each feature of an instance that the view shows. The instance's bounds, cut off at the near
// and far planes, are projected; of that box the pixels count at which `materials`, the channel material_id,
// has the instance's material and `positions`, the channel position, lies within its bounds: where there are
// none it is hidden, off the picture or turned away. Without a channel (nullptr) its word is not asked.
// Features without a check are left out.
std::vector<FeatureChecks> visualChecksOf(const Scene& scene, const Pose& pose, const View& view,
                                          const Image* materials, const Image* positions);

// As the Frame, drawn of this view, shows the scene.
std::vector<FeatureChecks> visualChecksOf(const Scene& scene, const SceneView& view, const Frame& frame);

}  // namespace diptych
