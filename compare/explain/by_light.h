// SPDX-License-Identifier: MIT
// Which lights a change of direct light is of, told by what each light adds to the picture.
#pragma once

#include "shared/image/image.h"

#include <cstddef>
#include <span>
#include <vector>

namespace diptych {

// What may have become of a light: it shines otherwise, by any factor; it is there in
// one picture and not in the other; or more or less of it is seen, anywhere from none to all, at each pixel
// for itself.
enum class LightChange { factor, whole, seen };

// Each light's share of `change` at each pixel: for each light, in order, one value a pixel; they add up to
// 1, or are 0 where no light accounts for the change. `terms`: what each light adds alone, W x H x 3 as
// `change`.
//
// In blocks of 8x8 pixels the light that accounts for most of the squared change is taken, then that which
// accounts for most of what is left, up to three and as long as each accounts for a twentieth. Lights that
// account for as much to within a fiftieth cannot be told apart: they share what they account for as they add
// to the picture. Factors are of light of all colours alike; where that leaves over a tenth, of each by
// itself.
std::vector<std::vector<float>> lightsOfChange(const Image& change, std::span<const Image> terms,
                                               LightChange how);

}  // namespace diptych
