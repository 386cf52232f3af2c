// SPDX-License-Identifier: MIT
// Options of `diff`.
#pragma once

#include "compare/cli/option_groups.h"
#include "compare/verdict/image_diff.h"

namespace diptych::cli {

struct DiffLine : OutputGroup, SelectionGroup, RulesGroup, KeepGroup {
    std::vector<std::string> images;  // reference and test
    ImageDiffOptions diff;            // all but the rules
    std::string metric_text;
    std::optional<double> tolerance_requested;
};

// Words of options that influence the verdict.
std::vector<std::string> verdictOptions(const DiffLine& options);

}  // namespace diptych::cli
