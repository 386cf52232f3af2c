// SPDX-License-Identifier: MIT
#include "compare/cli/command_tradeoff.h"
#include "compare/cli/exit_code.h"

#include "compare/cli/command.h"
#include "compare/cli/scene_items.h"
#include "compare/experiment/grid.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/files/diptych_files.h"
#include "compare/files/listed_folder.h"
#include "compare/files/output_folder.h"
#include "compare/files/scene_folders.h"
#include "compare/report/titles.h"
#include "compare/run/color.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "compare/shards/merge.h"
#include "compare/tradeoff/all_scenes.h"
#include "compare/tradeoff/sweep.h"
#include "compare/tradeoff/tables.h"
#include "compare/tradeoff/tradeoff.h"
#include "shared/text/counted.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/one_line.h"
#include "shared/text/open_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <stdexcept>

namespace diptych::cli {

using namespace tradeoff;

namespace {

namespace fs = std::filesystem;

struct TradeoffLine : ShardedGroup, GridGroup, RendererGroup {};

void describeTradeoff(CLI::App& app, TradeoffLine& options) {
    options.runs = 5;
    addScene(app, options, many_scenes_help);
    addFiles(app, options, "folder for the page, table and plots (diptych-tradeoff)");
    addShard(app, options, "diptych-tradeoff");
    addGrid(app, options, "each Setting alone, and declared pairs");
    addRenderers(app, options, "another renderer to add as a row");
    addOutput(app, options);
    acceptUnread(app, {"--debug", "--heat", "--channels", "--list-channels"});
}

void resolveTradeoff(TradeoffLine& options) {
    resolveScene(options);
    resolveRenderers(options);
}

void checkTradeoffOptions(const TradeoffLine& options) {
    if (options.runs < 1) refuse("--runs 0: tradeoff measures times; use 1 or more");
    checkMeasured(options.settings);
}

int sweepOne(const TradeoffLine& options, const experiment::SweepRows& rows) {
    const std::filesystem::path folder =
        outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoffManifest);
    SweepQuestion question{options.scenes.front(), options.cameras,        options.settings,     rows,
                           options.grid.empty(),   renderOptions(options), imageChoice(options), folder};
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    logVerbose(options, "on " + device.info().name);
    Sweep sweep(std::move(question), device, Stage(progress, options.scenes.front()));
    if (sweep.isRenewed())
        note(
            options,
            "the results of an interrupted sweep belong to another scene, device or Settings; starting anew");
    setInterruptionMessage(fmt::format("finished rows are kept in {}: the same command continues from there",
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
    noteLeftByOthers(options, sweep.referenceCheckpoints());
    if (options.json) printText(json);
    print(tradeoffEnd(sweep.tradeoff()) + (folder / "index.html").string() + "\n");
    printFirstError(errors);
    return exitCode(true, !errors.empty());
}

// Writes the page and the manifest, and returns the manifest. Called first without scenes, which marks the
// folder as ours, and again with all scenes.
std::string writePage(const OutputGroup& options, const fs::path& folder, const shards::Manifest& manifest,
                      const std::vector<const shards::Item*>& done) {
    std::vector<SweptScene> scenes;
    for (const shards::Item* item : done) scenes.push_back({item->scene, item->folder});
    std::vector<std::string> failures;
    for (const SceneError& error : manifest.errors) failures.push_back(errorText(error));
    return writeAllScenes(folder, parseOrderedJson(textOf(manifest)), scenes, failures, options.force);
}

void showMany(const OutputGroup& options, const fs::path& folder, const shards::Manifest& manifest,
              const std::vector<const shards::Item*>& done) {
    const std::string text = writePage(options, folder, manifest, done);
    if (options.json)
        printText(text);
    else if (!options.quiet)
        printOut("{}: {}\n", counted(done.size(), "scene"), (folder / "index.html").string());
}

// Scenes' outputs are written below it without following links.
OpenFolder heldOutput(const fs::path& folder) {
    OpenFolder open = OpenFolder::at(folder);
    if (!open.isOpen()) throw std::runtime_error(writingFailed(folder, errno));
    open.pin();
    return open;
}

int finish(const OutputGroup& options, const fs::path& folder, const shards::Manifest& manifest,
           const std::vector<const shards::Item*>& done) {
    showMany(options, folder, manifest, done);
    printFirstError(manifest.errors);
    return exitCode(true, !manifest.errors.empty());
}

// Many scenes, or a shard of them: a folder for each in `folder`, and a page that links them. An interrupted
// command resumes after its last scene. Scenes that cannot be read or rendered are reported, and the others
// continue.
int tradeoffMany(const TradeoffLine& options, const fs::path& folder, const experiment::SweepRows& rows) {
    const nlohmann::ordered_json asked =
        askedOf(options, {options.settings}, {{"command", "tradeoff"}, {"grid", options.grid}});
    const shards::SceneItems items = itemsOf(options, asked);
    CheckpointFolder checkpoints(folder, "scenes", resumeKey(options, asked));
    shards::Manifest manifest{shards::buildName(), "tradeoff", items.plan, items.shard, items.all, {}};
    std::vector<const shards::Item*> done;
    if (!isDiptychManifest(folder / tradeoffsManifest)) writePage(options, folder, manifest, {});
    const OpenFolder scenes = heldOutput(folder);
    for (const shards::Item* item : items.mine) {
        const std::string name = shards::partOf(*item);
        if (checkpoints.find(name) == shards::stampOf(item->scene) &&
            isDiptychManifest(folder / item->folder / tradeoffManifest)) {
            done.push_back(item);
            continue;
        }
        TradeoffLine one = options;
        one.scenes = {item->scene};
        one.out = folder / (item->folder.empty() ? "." : item->folder);
        one.json = false;
        one.quiet = options.quiet || options.json;
        const auto error = shards::attempt(item->scene, [&] {
            sweepOne(one, rows);
            checkpoints.keep(name, shards::stampOf(item->scene));
            done.push_back(item);
        });
        if (!error) continue;
        manifest.errors.push_back(*error);
        logVerbose(options, fmt::format("{}; continuing with the other scenes", error->message));
    }
    if (done.empty() && !manifest.errors.empty() && options.shard.empty())
        refuse("none of {} can be rendered; the first: {}", counted(items.all.size(), "scene"),
               manifest.errors.front().message);
    const int code = finish(options, folder, manifest, done);
    checkpoints.remove();
    return code;
}

int runTradeoff(const TradeoffLine& words) {
    TradeoffLine options = words;
    options.scenes = scenesOf(words.scenes);
    checkTradeoffOptions(options);
    const Settings& requested = options.settings;
    const experiment::SweepRows sweep = experiment::makeSweepRows(
        requested, options.grid.empty() ? experiment::defaultGrids(requested)
                                        : experiment::readGrids(options.grid, requested));
    if (options.debug_requested) note(options, "--debug is not used: errors are measured in lit");
    if (!options.channels.empty()) note(options, "--channels is not used: errors are measured in lit");
    if (options.scenes.size() == 1 && options.shard.empty()) return sweepOne(options, sweep);
    return tradeoffMany(options, outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoffsManifest),
                        sweep);
}

}  // namespace

int mergeTradeoffs(const OutputGroup& options, const std::vector<std::string>& shards) {
    const fs::path folder = outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoffsManifest);
    shards::Chosen chosen = shards::choose({shards.begin(), shards.end()}, tradeoffsManifest);
    std::vector<const shards::Item*> done;
    writePage(options, folder, chosen.manifest, {});
    const OpenFolder scenes = heldOutput(folder);
    for (const shards::Item& item : chosen.manifest.items) {
        if (const std::optional<SceneError> error = chosen.errorOf(item)) {
            chosen.manifest.errors.push_back(*error);
            continue;
        }
        const fs::path& from = chosen.folders.at(item.shard);
        const std::string manifest = item.folder + tradeoffManifest;
        std::vector<std::string> names = listedIn(from / manifest);
        std::erase(names, tradeoffManifest);
        try {
            checkSwept(from, {item.scene, item.folder}, names);
        } catch (const std::runtime_error& problem) {
            chosen.problems.push_back(
                fmt::format("{}: the tradeoff is incomplete: {}", from.string(), problem.what()));
            chosen.manifest.errors.push_back({item.scene, problem.what()});
            continue;
        }
        ListedFolder out(folder / item.folder, tradeoffManifest, options.force);
        for (const std::string& name : names) {
            copyBelow(from, item.folder + name, out / name);
            out.list(name);
        }
        out.finish(escapeControls(textBelow(from, manifest, json_bytes)));
        done.push_back(&item);
    }
    const shards::Manifest manifest = chosen.manifest;
    if (chosen.problems.empty()) return finish(options, folder, manifest, done);
    showMany(options, folder, manifest, done);
    printIncomplete(options, chosen.problems, folder / "index.html");
    return exit_error;
}

Command tradeoffCommand() {
    return makeCommand<TradeoffLine>(
        {"tradeoff", "Renders a scene with many Settings: time and error of each, and the Pareto front",
         "diptych tradeoff helmet.glb --size 320x180 -o helmet-tradeoff",
         "grid lights shadows camera size runs shard device out json"},
        describeTradeoff, resolveTradeoff, runTradeoff);
}

}  // namespace diptych::cli
