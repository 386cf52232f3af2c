// SPDX-License-Identifier: MIT
// What decided a verdict: one figure, as it was measured, and its limit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace diptych {

struct Criterion {
    // A figure of rules.h, "p99.9", "pixels unexplained", "times the bits", "times the bounds" (of smooth
    // pixels), "flip of detail", "pixels NaN or infinite", "p99.9 of the excess" (certainErrors()).
    std::string figure;
    double measured = 0;
    double limit = 0;               // the most that passes, or with `least` the least
    bool least = false;             // of psnr and ssim
    std::optional<double> above{};  // where the figure is a share of pixels: those with errors above this
    // Covered pixels beyond the limit; where the figure is of the whole channel (a mean, FLIP), those that
    // differ at all.
    std::uint64_t pixels = 0;
    double share = 0;        // the same of all covered pixels, 0 to 1
    bool differing = false;  // `pixels` are those that differ
};

// How much of its limit is used: 1 just passes; infinite where the limit is 0 and the figure is not.
double usedOf(const Criterion& criterion);

// ", at 12.3 % of the pixels", or of a figure of the whole channel "; 12.3 % of the pixels differ".
std::string shareText(const Criterion& criterion);

// "12.3 %"; never "0 %" of what is not none, nor "100 %" of what is not all.
std::string percentText(double share);

}  // namespace diptych
