// SPDX-License-Identifier: MIT
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/command_compare.h"
#include "compare/cli/command_tradeoff.h"
#include "compare/cli/exit_code.h"
#include "compare/shards/merge.h"
#include "compare/tradeoff/all_scenes.h"
#include "shared/text/counted.h"
#include "shared/text/json_at.h"

#include <algorithm>
#include <stdexcept>

namespace diptych::cli {

namespace {

struct MergeLine : OutputGroup, SinceGroup {
    std::vector<std::string> shards;  // their folders
};

void describeMerge(CLI::App& app, MergeLine& options) {
    addOption(app, "folders", options.shards, "DIR...", "report folders of all shards");
    addFiles(app, options, "report folder (diptych-report)");
    addSince(app, options);
    addOutput(app, options);
}

Keep keepOf(const nlohmann::ordered_json& plan) {
    const JsonAt asked = JsonAt(plan, "merge: the plan of the shards").at("asked");
    return asked.has("keep") ? static_cast<Keep>(asked.at("keep").whole(0, 2)) : Keep::all;
}

int runMerge(const MergeLine& options) {
    if (options.shards.empty())
        refuse("merge: the folders of the shards are missing; for example diptych merge shard-*/ -o report");
    const bool tradeoffs = std::ranges::any_of(options.shards, [](const std::string& shard) {
        return std::filesystem::exists(std::filesystem::path(shard) / tradeoff::tradeoffsManifest);
    });
    if (tradeoffs) return mergeTradeoffs(options, options.shards);
    const std::filesystem::path folder = outputFolder(options, "diptych-report", "report", "report.json");
    checkSince(options);
    shards::Joined joined = shards::join({options.shards.begin(), options.shards.end()});
    if (joined.report.parts.empty() && joined.report.errors.empty() && !joined.problems.empty())
        throw std::runtime_error(joined.problems.front());
    if (joined.report.parts.empty() && !joined.report.errors.empty())
        refuse("none of {} was rendered; the first: {}", counted(joined.manifest.items.size(), "scene"),
               joined.report.errors.front().message);
    ReportOptions report;
    report.keep = keepOf(joined.manifest.plan);
    report.force = options.force;
    const ReportPart whole = joinedOf(joined.report);
    report.since = sinceOf(options, whole.report, whole.rows);
    writeWhole(joined.report, whole, folder, report);
    showWhole(options, whole, folder, report.since.get(), false);
    if (joined.problems.empty()) {
        printFirstError(whole.report.errors);
        return exitCode(whole.report.passed(), !whole.report.errors.empty());
    }
    printIncomplete(options, joined.problems, folder / "index.html");
    return exit_error;
}

}  // namespace

Command mergeCommand() {
    return makeCommand<MergeLine>(
        {"merge", "Merges the reports of shards, in any order, into one", "diptych merge shard-*/ -o report"},
        describeMerge, [](MergeLine& options) { refuseLineBreaks(options.shards); }, runMerge);
}

}  // namespace diptych::cli
