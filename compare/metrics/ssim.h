// SPDX-License-Identifier: MIT
// Structural similarity of one plane of values.
#pragma once

#include "shared/image/image.h"

#include <cstdint>
#include <optional>
#include <span>

namespace diptych::metrics {

// Of two planes W x H x 1 of values in [0, 1] as PlainMetrics::ssim says: the mean over windows within the
// picture whose middle is covered (not 0) and that hold no NaN; none where no such window is. Throws
// std::runtime_error where sizes differ. The result does not depend on the number of threads.
std::optional<double> ssim(const Image& reference, const Image& test, std::span<const std::uint8_t> covered);

}  // namespace diptych::metrics
