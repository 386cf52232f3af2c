// SPDX-License-Identifier: MIT
#pragma once

#include "compare/verdict/comparison.h"

#include <string>
#include <vector>

namespace diptych::cli {

struct Options;

// Options of `compare` that influence a verdict. Reads the rules; throws std::runtime_error, one line, if
// they are invalid or name an unknown channel.
CompareOptions compareOptions(const Options& options);

// Words of options that influence a verdict (rules, pixels, metric), without scene, camera and Settings.
std::vector<std::string> wordsOfWhatCounts(const Options& options);

}  // namespace diptych::cli
