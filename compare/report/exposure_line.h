// SPDX-License-Identifier: MIT
// Describes the exposure of images, and reads the exposure of another image.
#pragma once

#include "compare/image/channel_image.h"
#include "compare/verdict/comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// "exposure 1.3, automatic: 0.18 / log-average luminance 0.14". For several comparisons with different
// exposures: their range, and how to set one for all.
std::string exposureLine(const Frame& frame, const ImageChoice& choice);
std::string exposureLine(const Report& report, const ImageChoice& choice);
std::string exposureLine(const std::vector<Exposure>& all);  // one per comparison
Exposure exposureOf(const Report& report, const Comparison& comparison, const ImageChoice& choice);

// The automatic exposure factor of a linear image file: from lit, or from the first colours of an external
// renderer's file. Throws std::runtime_error if the file cannot be read or has no radiance.
double exposureOfFile(const std::filesystem::path& file);

}  // namespace diptych
