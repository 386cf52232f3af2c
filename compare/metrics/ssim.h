// SPDX-License-Identifier: MIT
// Structural similarity of one plane of values.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace diptych::metrics {

// Writes row y of a plane of values in [0, 1]. Several threads call it concurrently.
using PlaneRow = std::function<void(float* out, int y)>;

// SSIM of two planes as in StandardMetrics::ssim: the mean over windows inside the image with a covered
// centre (not 0) and without NaN; none if there is no such window. Throws std::runtime_error unless
// `covered` has one value per pixel. Each thread needs 252 rows. The number of threads does not change the
// result.
std::optional<double> ssim(int width, int height, const PlaneRow& reference, const PlaneRow& test,
                           std::span<const std::uint8_t> covered);

}  // namespace diptych::metrics
