// SPDX-License-Identifier: MIT
// Attributes a change of direct light to lights, by each light's contribution to the image.
#pragma once

#include "shared/image/image.h"

#include <cstddef>
#include <span>
#include <vector>

namespace diptych {

// How a light may have changed. factor: its intensity is scaled; whole: it exists in one image only; seen:
// its visibility changes, at each pixel independently.
enum class LightChange { factor, whole, seen };

// Each light's fraction of `change` at each pixel, indexed like `terms`, one value per pixel. The
// fractions sum to 1, or are all 0 where no light accounts for the change. `terms`: each light's own
// contribution, W x H x 3 like `change`.
//
// Works on blocks of 8x8 pixels. The light that accounts for most of the squared change is subtracted
// first, then the next, up to three, as long as each accounts for at least a twentieth. Lights whose
// accounts differ by less than a fiftieth are indistinguishable and share the result in proportion to
// their contributions. Factors are grey; if more than a tenth of the squared change remains, each colour
// gets its own factor.
std::vector<std::vector<float>> lightsOfChange(const Image& change, std::span<const Image> terms,
                                               LightChange how);

}  // namespace diptych
