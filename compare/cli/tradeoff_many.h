// SPDX-License-Identifier: MIT
#pragma once

#include "compare/cli/options.h"

#include <filesystem>
#include <functional>

namespace diptych::cli {

inline constexpr const char* tradeoffsManifest = "tradeoffs.json";

// tradeoff of many scenes, or of a shard's share of them: each has a folder in `folder` with a tradeoff of
// its own, which `sweep` writes there, and a page leads to them. The same command goes on behind the last one
// of one that was cut short. A scene that cannot be read or drawn is named, and the others are swept.
int tradeoffMany(const Options& options, const std::filesystem::path& folder,
                 const std::function<void(const Options&)>& sweep);

// merge of what shards of it wrote.
int mergeTradeoffs(const Options& options);

}  // namespace diptych::cli
