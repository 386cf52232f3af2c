// SPDX-License-Identifier: MIT
#pragma once

#include "compare/cli/output_group.h"

namespace diptych::cli {

// Merges the results of `tradeoff` for shards of many scenes. Returns the exit code.
int mergeTradeoffs(const OutputGroup& options, const std::vector<std::string>& shards);

}  // namespace diptych::cli
