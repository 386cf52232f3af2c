// SPDX-License-Identifier: MIT
// Which exposure pictures got, and taking over that of another picture.
#pragma once

#include "compare/picture/picture.h"
#include "compare/verdict/comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// "exposure 1.3, automatic: 0.18 / log-average luminance 0.14"; of several comparisons with exposures of
// their own the range, and how all get the same.
std::string exposureLine(const Frame& frame, const PictureChoice& choice);
std::string exposureLine(const Report& report, const PictureChoice& choice);
std::string exposureLine(const std::vector<Exposure>& all);  // one per comparison
Exposure exposureOf(const Report& report, const Comparison& comparison, const PictureChoice& choice);

// The factor that a picture of this linear file gets by itself: of lit, or of the first colours of another
// renderer's file. Throws std::runtime_error where the file cannot be read or holds no radiance.
double exposureOfFile(const std::filesystem::path& file);

}  // namespace diptych
