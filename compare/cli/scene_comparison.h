// SPDX-License-Identifier: MIT
// The requested comparisons; unsupported ones are refused.
#pragma once

#include "compare/cli/options.h"
#include "compare/experiment/comparison.h"
#include "compare/explain/explanations.h"

#include <optional>
#include <vector>

namespace diptych::cli {

experiment::Compared comparedOf(const Options& options);

// Whether the baseline is a reference in mode scene, rendered now or read from a file.
bool isTraced(const std::vector<Settings>& settings, const std::optional<Frame>& baseline);

// Checks a multisampled comparison with the reference. Throws std::runtime_error, one line, if the sample
// counts do not match, or if --channels lacks lit: only lit is compared then.
void checkSamples(const Options& options, const std::vector<Settings>& settings,
                  const std::optional<Frame>& baseline);

// Throws std::runtime_error, one line, for options that a cross-device comparison does not support.
void checkAgainstDevice(const Options& options, const std::vector<Settings>& settings);

ExplanationQuestion explanationOf(const Options& options);

}  // namespace diptych::cli
