// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/cli/compare_many.h"
#include "compare/cli/tradeoff_many.h"
#include "compare/shards/merge.h"
#include "compare/tradeoff/all_scenes.h"
#include "shared/text/counted.h"
#include "shared/text/json_at.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych::cli {

namespace {

Keep keepOf(const nlohmann::ordered_json& plan) {
    const JsonAt asked = JsonAt(plan, "merge: the plan of the shards").at("asked");
    return asked.has("keep") ? static_cast<Keep>(asked.at("keep").whole(0, 2)) : Keep::all;
}

}  // namespace

int runMerge(const Options& options) {
    if (!options.scene_given)
        throw std::runtime_error(
            "merge: the folders of the shards are missing; for example diptych merge shard-*/ -o report");
    const bool tradeoffs = std::ranges::any_of(options.scenes, [](const std::string& shard) {
        return std::filesystem::exists(std::filesystem::path(shard) / tradeoff::tradeoffsManifest);
    });
    if (tradeoffs) return mergeTradeoffs(options);
    const std::filesystem::path folder = outputFolder(options, "diptych-report", "report", "report.json");
    checkSince(options);
    shards::Joined joined = shards::join({options.scenes.begin(), options.scenes.end()});
    if (joined.report.parts.empty() && joined.report.errors.empty() && !joined.problems.empty())
        throw std::runtime_error(joined.problems.front());
    if (joined.report.parts.empty() && !joined.report.errors.empty())
        throw std::runtime_error(fmt::format("none of {} was rendered; the first: {}",
                                             counted(joined.manifest.items.size(), "scene"),
                                             joined.report.errors.front().message));
    ReportOptions report;
    report.keep = keepOf(joined.manifest.plan);
    report.force = options.force;
    const Report summary = summaryOf(joined.report);
    report.since = sinceOf(options, summary, rowsOf(joined.report));
    writeWhole(joined.report, summary, folder, report);
    showWhole(options, joined.report, summary, folder, report.since.get(), false);
    if (joined.problems.empty()) {
        sayErrors(summary.errors);
        return exitCodeOf(summary);
    }
    sayProblems(options, joined.problems, folder / "index.html");
    return 2;
}

}  // namespace diptych::cli
