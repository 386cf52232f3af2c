// SPDX-License-Identifier: MIT
// Splits lit's error against the reference into the parts that tolerances grant to each approximation.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <string>
#include <vector>

namespace diptych {

// Of one approximation: the relative error that it is granted, over covered pixels. That is the part of a
// pixel's error that its tolerance takes there.
struct Granted {
    std::string name;     // "split IBL"
    std::string setting;  // removes it: "--ibl sampled"; empty: none does
    double mean = 0, p999 = 0;
};

// Those of the channel in a comparison of a path with the reference, largest first; without those that are
// granted nothing.
std::vector<Granted> grantedIn(const DebugMode& mode, const FramePair& pair);

// Sum of the means.
double grantedMean(const std::vector<Granted>& granted);

// "lit is off by 31 % in the mean, granted to split IBL: --ibl sampled"; empty if nothing is granted.
std::string grantedText(const DebugMode& mode, const std::vector<Granted>& granted);

// Larger means are a warning, and a failure with --strict.
inline constexpr double maxGranted = 0.05;

}  // namespace diptych
