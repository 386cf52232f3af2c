// SPDX-License-Identifier: MIT
// Divides lit's error against the reference among the approximations for which its tolerance has a part.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <string>
#include <vector>

namespace diptych {

// The relative error of one approximation over covered pixels: at each pixel, the part of lit's error that
// the approximation's part of the tolerance allows.
struct ApproximationError {
    std::string name;     // "split IBL"
    std::string setting;  // removes it: "--ibl sampled"; empty: none does
    double mean = 0, p999 = 0;
};

// The errors of a channel, largest mean first, without those of mean 0. Empty unless the pair is a path and
// the reference.
std::vector<ApproximationError> approximationErrors(const DebugMode& mode, const FramePair& pair);

// Sum of the means.
double meanApproximationError(const std::vector<ApproximationError>& errors);

// "lit is off by 31 % in the mean, granted to split IBL: --ibl sampled"; empty without errors.
std::string approximationErrorText(const DebugMode& mode, const std::vector<ApproximationError>& errors);

// Larger means are a warning, and a failure with --strict.
inline constexpr double maxApproximationError = 0.05;

}  // namespace diptych
