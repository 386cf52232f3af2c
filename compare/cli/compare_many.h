// SPDX-License-Identifier: MIT
#pragma once

#include "compare/cli/options.h"
#include "compare/report/whole_report.h"

#include <filesystem>
#include <vector>

namespace diptych::cli {

// compare for many scenes, or for a shard of them. Writes a report part beside `folder` after each scene,
// and the whole report at the end. An interrupted command resumes after its last part. The next scene
// loads while one is compared. A scene that cannot be read or rendered is an error of the report.
// `settings`: all cameras, times and paths.
int compareMany(const Options& options, const std::vector<Settings>& settings,
                const std::filesystem::path& folder);

// Prints the results of a report of many scenes in `folder`. `all`: includes comparisons that pass.
void showWhole(const Options& options, const WholeReport& whole, const Report& summary,
               const std::filesystem::path& folder, const Trends* since, bool all);
int exitCodeOf(const Report& summary);

}  // namespace diptych::cli
