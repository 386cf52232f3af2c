// SPDX-License-Identifier: MIT
#include "compare/cli/compare_many.h"

#include "compare/cli/commands.h"
#include "compare/cli/scene_comparison.h"
#include "compare/cli/scene_items.h"
#include "compare/cli/verdict_words.h"
#include "compare/render/reference_frame.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "compare/shards/collection.h"
#include "compare/verdict/pair_reports.h"
#include "shared/text/counted.h"
#include "shared/text/input_file.h"

#include <fmt/format.h>

#include <stdexcept>

namespace diptych::cli {

namespace {

namespace fs = std::filesystem;

}  // namespace

int compareMany(const Options& options, const std::vector<Settings>& settings, const fs::path& folder) {
    if (!options.baseline_file.empty())
        throw std::runtime_error(fmt::format("--shard {}: --baseline {} holds one view; leave out --shard",
                                             options.shard, options.baseline_file.string()));
    if (options.single_file && !options.shard.empty())
        throw std::runtime_error(
            "--single-file: merge takes a shard's images from beside its page; leave it out");
    const shards::CollectionQuestion question{
        settings,
        comparedOf(options),
        compareOptions(options),
        judgedOptions(renderOptions(options), settings, isTraced(settings, {}),
                      !options.against_device.empty(), options.twice),
        explanationOf(options),
        {pictureChoice(options), options.single_file, options.keep, options.force},
        folder,
        resumeKey(options, settings),
        [&](const std::string& line) { note(options, line); },
        [&](const std::string& line) { say(options, line); }};
    const shards::SceneItems items = itemsOf(options, settings);
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    const std::unique_ptr<Device> other = againstDevice(options);
    say(options, "on " + device.info().name + (other ? " and " + other->info().name : ""));
    shards::Collection collection(question, items, device, other.get(), progress);
    sayWhenInterrupted(fmt::format("finished scenes are kept in {}: the same command continues from there",
                                   collection.keptIn().string()));
    collection.compareAll();
    sayWhenInterrupted("");
    WholeReport whole = collection.whole();
    if (whole.parts.empty() && options.shard.empty())
        throw std::runtime_error(fmt::format("none of {} can be rendered; the first: {}",
                                             counted(items.all.size(), "scene"),
                                             whole.errors.front().message));
    if (!options.shard.empty())
        whole.shard = textOf(shards::Manifest{shards::buildName(), "compare", items.plan, items.shard,
                                              items.all, whole.errors});
    const Report summary = summaryOf(whole);
    ReportOptions report = question.report;
    report.since = sinceOf(options, summary, rowsOf(whole));
    writeWhole(whole, summary, folder, report);
    collection.remove();
    progress.wipe();
    noteLeftByOthers(options, KeptReferences(folder, true));
    showWhole(options, whole, summary, folder, report.since.get(), true);
    sayErrors(summary.errors);
    return exitCodeOf(summary);
}

void showWhole(const Options& options, const WholeReport& whole, const Report& summary,
               const fs::path& folder, const Trends* since, bool all) {
    if (options.json) {
        InputFile report(folder / "report.json");
        printFile(report);
    } else if (!options.quiet) {
        const std::string exposures = wholeExposureLine(whole);
        printColored(options, fmt::format("{}{}{}report: {}\n", wholeTable(whole, summary, all),
                                          sinceText(since, summary),
                                          exposures.empty() ? "" : fmt::format("pictures: {}\n", exposures),
                                          (folder / "index.html").string()));
    }
}

int exitCodeOf(const Report& summary) {
    return !summary.errors.empty() ? 2 : summary.passed() ? 0 : 1;
}

}  // namespace diptych::cli
