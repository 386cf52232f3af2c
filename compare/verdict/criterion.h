// SPDX-License-Identifier: MIT
// The metric that decided a verdict, as measured, and its limit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace diptych {

struct Criterion {
    // A metric of rules.h, "p99.9", "pixels unexplained", "times the bounds", "flip of detail", "pixels
    // NaN or infinite", "p99.9 of the excess" (certainErrors()).
    std::string figure;
    double measured = 0;
    double limit = 0;               // largest value that passes; with `least` the smallest
    bool least = false;             // for psnr and ssim
    std::optional<double> above{};  // if the metric is a fraction of pixels: their error threshold
    // Covered pixels out of tolerance; for a metric of the whole channel (a mean, FLIP), those that differ
    // at all.
    std::uint64_t pixels = 0;
    double share = 0;        // `pixels` as a fraction of all covered pixels, 0 to 1
    bool differing = false;  // `pixels` counts pixels that differ
};

// Fraction of the limit that is used: 1 just passes; infinite if the limit is 0 and the metric is not.
double usedOf(const Criterion& criterion);

// ", at 12.3 % of the pixels"; for a metric of the whole channel "; 12.3 % of the pixels differ".
std::string shareText(const Criterion& criterion);

// "12.3 %"; never "0 %" for a non-zero share, nor "100 %" for less than all.
std::string percentText(double share);

}  // namespace diptych
