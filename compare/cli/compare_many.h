// SPDX-License-Identifier: MIT
#pragma once

#include "compare/cli/options.h"
#include "compare/report/parts.h"

#include <filesystem>
#include <vector>

namespace diptych::cli {

// compare of many scenes, or of a shard's share of them: one after the other, each of which leaves a part of
// the report beside `folder` as soon as it is compared, while the next is loaded; the report is put together
// at the end. The same command goes on behind the last part of one that was cut short. A scene that cannot be
// read or drawn is an error of the report. `settings`: of every camera, time and path.
int compareMany(const Options& options, const std::vector<Settings>& settings,
                const std::filesystem::path& folder);

// Prints what a report of many scenes that was written to `folder` says; `all`: also of comparisons that
// pass.
void showWhole(const Options& options, const WholeReport& whole, const Report& summary,
               const std::filesystem::path& folder, const Trends* since, bool all);
int exitCodeOf(const Report& summary);

}  // namespace diptych::cli
