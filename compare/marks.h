// SPDX-License-Identifier: MIT
// Where both paths may be wrong alike, so that no comparison of the two can show it and a person has to look.
#pragma once

#include "shared/frame/frame.h"
#include "shared/image/image.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

struct Pose;
struct Scene;
struct View;

// Pixels from (x0, y0), at the top left, up to but not including (x1, y1).
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
    bool operator==(const PixelBox&) const = default;
};

// One feature of the scene at one place. The names in it are the file's: nobody has escaped them.
struct Mark {
    std::string what;   // one sentence: what is seen there if it is right
    std::string name;   // short, of the place
    std::string where;  // material, mesh and node
    PixelBox box;       // around what is seen of it; never empty
    std::uint64_t pixels = 0;
};

// The marks of one feature, largest first.
struct FeatureMarks {
    std::string_view feature;
    std::uint64_t found = 0;  // in view, of which at most `marksShown` are told
    std::vector<Mark> marks;
};
inline constexpr std::size_t marksShown = 24;

// One mark for each feature of an instance that the view shows. The instance's bounds, cut off at the near
// and far planes, are projected; of that box the pixels count at which `materials`, the channel material_id,
// has the instance's material and `positions`, the channel position, lies within its bounds: where there are
// none it is hidden, off the picture or turned away. Without a channel (nullptr) its word is not asked.
// Features without a mark are left out.
std::vector<FeatureMarks> marksOf(const Scene& scene, const Pose& pose, const View& view,
                                  const Image* materials, const Image* positions);

// As the Frame shows the scene: with its time, camera and size.
std::vector<FeatureMarks> marksOf(const Scene& scene, const Frame& frame);

}  // namespace diptych
