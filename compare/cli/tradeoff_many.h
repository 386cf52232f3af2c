// SPDX-License-Identifier: MIT
#pragma once

#include "compare/cli/options.h"

#include <filesystem>
#include <functional>

namespace diptych::cli {

// tradeoff for many scenes, or for a shard of them. `sweep` writes one folder per scene in `folder`; a
// page links them. An interrupted command resumes after its last scene. Scenes that cannot be read or
// rendered are reported, and the others continue.
int tradeoffMany(const Options& options, const std::filesystem::path& folder,
                 const std::function<void(const Options&)>& sweep);

// Merges the results of shards.
int mergeTradeoffs(const Options& options);

}  // namespace diptych::cli
