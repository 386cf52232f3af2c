// SPDX-License-Identifier: MIT
// Structural similarity of one plane of values.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace diptych::metrics {

// Writes row y of a plane, whose values are in [0, 1]. Called by several threads at once.
using PlaneRow = std::function<void(float* out, int y)>;

// Of two planes as PlainMetrics::ssim says: the mean over windows within the picture whose middle is covered
// (not 0) and that hold no NaN; none where no such window is. Throws std::runtime_error where `covered` has
// not a value for each pixel. Each thread holds 252 rows; their number does not change the result.
std::optional<double> ssim(int width, int height, const PlaneRow& reference, const PlaneRow& test,
                           std::span<const std::uint8_t> covered);

}  // namespace diptych::metrics
