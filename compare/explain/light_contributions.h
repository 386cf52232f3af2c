// SPDX-License-Identifier: MIT
// Attributes a change of direct light to lights, by each light's contribution to the image.
#pragma once

#include "compare/explain/ablation.h"
#include "compare/explain/explanation.h"
#include "compare/explain/lighting_components.h"
#include "shared/image/image.h"

#include <span>
#include <vector>

namespace diptych {

// Each light's part of a cause's contribution, unordered; empty if the cause is not direct light or shadows.
// Renders the lights alone on the test's surfaces, and counts them in Explanation::lights_drawn and
// lights_left_out. `map`: as Cause::map, one value per pixel.
std::vector<CausePart> lightParts(const AblationCause& cause, const std::vector<double>& map,
                                  const Ablation& ablation, Explanation& found);

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
