// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace diptych::cli {

struct Options;

// The words of `options` beside scene, camera and Settings that decide a verdict: rules, pixels, metric.
std::vector<std::string> wordsOfWhatCounts(const Options& options);

}  // namespace diptych::cli
