// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/cli/tradeoff_many.h"
#include "compare/experiment/grid.h"
#include "compare/files/scene_folders.h"
#include "compare/run/color.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "compare/tradeoff/all_scenes.h"
#include "compare/tradeoff/sweep.h"
#include "compare/tradeoff/tables.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace diptych::cli {

using namespace tradeoff;

namespace {

void checkTradeoffOptions(const Options& options) {
    if (options.runs < 1) throw std::runtime_error("--runs 0: tradeoff measures times; use 1 or more");
    if (isReference(options.settings.path))
        throw std::runtime_error(
            "--path reference: errors are measured against it; use deferred or forward_plus");
    if (const auto problem = referenceSettings(options.settings).problem())
        throw std::runtime_error(*problem);
}

int sweepOne(const Options& options, const experiment::SweepRows& rows) {
    const std::filesystem::path folder =
        outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoffManifest);
    SweepQuestion question{options.scenes.front(), options.cameras,        options.settings,       rows,
                           options.grid.empty(),   renderOptions(options), pictureChoice(options), folder};
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    say(options, "on " + device.info().name);
    Sweep sweep(std::move(question), device, Stage(progress, options.scenes.front()));
    if (sweep.isRenewed())
        note(options,
             "the results of an interrupted sweep belong to another scene, device or Settings; starting "
             "anew");
    sayWhenInterrupted(fmt::format("finished rows are kept in {}: the same command continues from there",
                                   SweepState::folderOf(folder).string()));
    const auto print = [&](const std::string& text) { printLive(options, progress, text); };
    const TradeoffTable table(sweep.tradeoff(), sweep.rows(), terminalColumns(stdout), options.verbose);
    // Once a minute, somebody who watches sees the fronts so far.
    using Clock = std::chrono::steady_clock;
    Clock::time_point next = Clock::now() + std::chrono::minutes(1);
    const auto shown = [&](std::size_t row) {
        print(table.line(sweep.tradeoff(), row));
        if (terminalColumns(stdout) == 0 || Clock::now() < next) return;
        print(fmt::format("so far, after {}:\n{}", counted(row + 1, "row"), frontsText(sweep.tradeoff())));
        next = Clock::now() + std::chrono::minutes(1);
    };
    print(table.head());
    sweep.draw(shown);
    const std::vector<SceneError> errors = sweep.drawExternally(options.renderers, shown);
    checkValidation(device);
    const std::string json = sweep.write(options.force);
    progress.wipe();
    noteLeftByOthers(options, sweep.keptReferences());
    if (options.json) printText(json);
    print(tradeoffEnd(sweep.tradeoff()) + (folder / "index.html").string() + "\n");
    sayErrors(errors);
    return errors.empty() ? 0 : 2;
}

}  // namespace

int runTradeoff(const Options& words) {
    Options options = words;
    options.scenes = scenesOf(words.scenes);
    checkTradeoffOptions(options);
    const Settings& given = options.settings;
    const experiment::SweepRows sweep =
        experiment::makeSweepRows(given, options.grid.empty() ? experiment::defaultGrids(given)
                                                              : experiment::readGrids(options.grid, given));
    if (options.debug_given) note(options, "--debug is not used: errors are measured in lit");
    if (!options.channels.empty()) note(options, "--channels is not used: errors are measured in lit");
    if (options.scenes.size() == 1 && options.shard.empty()) return sweepOne(options, sweep);
    return tradeoffMany(options, outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoffsManifest),
                        [&](const Options& one) { sweepOne(one, sweep); });
}

}  // namespace diptych::cli
