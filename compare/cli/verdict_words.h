// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace diptych::cli {

struct Options;

// The words of the options that influence a verdict, except scene, camera and Settings: rules, pixels,
// metric.
std::vector<std::string> wordsOfWhatCounts(const Options& options);

}  // namespace diptych::cli
