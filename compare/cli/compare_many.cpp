// SPDX-License-Identifier: MIT
#include "compare/cli/command_compare.h"
#include "compare/cli/exit_code.h"
#include "compare/cli/scene_items.h"
#include "compare/report/exposure_line.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "compare/shards/collection.h"
#include "shared/text/counted.h"
#include "shared/text/input_file.h"

#include <fmt/format.h>

namespace diptych::cli {

namespace {

// Options of compare alone that affect the result.
nlohmann::ordered_json ownOf(const CompareLine& options) {
    nlohmann::ordered_json own{{"command", "compare"},
                               {"baseline", nameOf(options.baseline)},
                               {"twice", static_cast<int>(options.twice)},
                               {"what counts", verdictOptions(options)},
                               {"explain", options.explain},
                               {"keep", static_cast<int>(options.keep)},
                               {"single_file", options.single_file}};
    addContents(own, {{"tolerances", options.tolerances}, {"mask", options.selection.mask}});
    return own;
}

}  // namespace

int compareMany(const CompareLine& options, const std::vector<Settings>& settings,
                const std::filesystem::path& folder) {
    if (!options.baseline_file.empty())
        refuse("--shard {}: --baseline {} holds one view; leave out --shard", options.shard,
               options.baseline_file.string());
    if (options.single_file && !options.shard.empty())
        refuse("--single-file: merge takes a shard's images from beside its page; leave it out");
    const nlohmann::ordered_json asked = askedOf(options, settings, ownOf(options));
    const shards::CollectionQuestion question{
        settings,
        comparedOf(options),
        compareOptions(options),
        evaluatedOptions(renderOptions(options), settings, isTraced(settings, {}),
                         !options.against_device.empty(), options.twice),
        explanationOf(options),
        {imageChoice(options), options.single_file, options.keep, options.force},
        folder,
        resumeKey(options, asked),
        [&](const std::string& line) { note(options, line); },
        [&](const std::string& line) { logVerbose(options, line); }};
    const shards::SceneItems items = itemsOf(options, asked);
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    const std::unique_ptr<Device> other = againstDevice(options);
    logVerbose(options, "on " + device.info().name + (other ? " and " + other->info().name : ""));
    shards::Collection collection(question, items, device, other.get(), progress);
    setInterruptionMessage(
        fmt::format("finished scenes are kept in {}: the same command continues from there",
                    collection.checkpointedIn().string()));
    collection.compareAll();
    setInterruptionMessage("");
    WholeReport whole = collection.whole();
    if (whole.parts.empty() && options.shard.empty())
        refuse("none of {} can be rendered; the first: {}", counted(items.all.size(), "scene"),
               whole.errors.front().message);
    if (!options.shard.empty())
        whole.shard = textOf(shards::Manifest{shards::buildName(), "compare", items.plan, items.shard,
                                              items.all, whole.errors});
    const ReportPart joined = joinedOf(whole);
    ReportOptions report = question.report;
    report.since = sinceOf(options, joined.report, joined.rows);
    writeWhole(whole, joined, folder, report);
    collection.remove();
    progress.wipe();
    noteLeftByOthers(options, ReferenceCheckpoints(folder, true));
    showWhole(options, joined, folder, report.since.get(), true);
    printFirstError(joined.report.errors);
    return exitCode(joined.report.passed(), !joined.report.errors.empty());
}

void showWhole(const OutputGroup& options, const ReportPart& joined, const std::filesystem::path& folder,
               const Trends* since, bool all) {
    if (options.json) {
        InputFile report(folder / "report.json");
        printFile(report);
    } else if (!options.quiet) {
        const std::string exposures = exposureLine(joined.exposures);
        printColored(options,
                     fmt::format("{}{}{}report: {}\n", tableOf(joined, all), sinceText(since, joined.report),
                                 exposures.empty() ? "" : fmt::format("pictures: {}\n", exposures),
                                 (folder / "index.html").string()));
    }
}

}  // namespace diptych::cli
