// SPDX-License-Identifier: MIT
#pragma once

#include "compare/verdict/comparison.h"

#include <string>
#include <vector>

namespace diptych::cli {

struct Options;

// What `compare` was told about what counts. Reads the rules; throws std::runtime_error, one line, where they
// are wrong or name no channel.
CompareOptions compareOptions(const Options& options);

// The words of the options that influence a verdict, except scene, camera and Settings: rules, pixels,
// metric.
std::vector<std::string> wordsOfWhatCounts(const Options& options);

}  // namespace diptych::cli
