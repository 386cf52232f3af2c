// SPDX-License-Identifier: MIT
#include "compare/bench/bench.h"
#include "compare/bench/registers.h"
#include "compare/cli/commands.h"
#include "compare/files/output.h"
#include "compare/run/print.h"

#include <fmt/format.h>

#include <optional>
#include <span>
#include <stdexcept>

namespace diptych::cli {

using namespace bench;

namespace {

void checkBenchOptions(const Options& options) {
    if (options.scenes.size() != 1)
        throw std::runtime_error(
            fmt::format("{}: bench takes one scene; run it once for each", options.scenes[1]));
    if (options.cameras.size() != 1)
        throw std::runtime_error("--camera: bench takes one camera; run it once for each");
    if (options.runs < 1) throw std::runtime_error("--runs 0: bench measures times; use 1 or more");
    if (isReference(options.settings.path))
        throw std::runtime_error(
            "--path reference: bench does not time the reference; use deferred or forward_plus");
    if (!options.compile_on.empty() && options.bench.table != BenchTable::layers)
        throw std::runtime_error("--compile-on: bench needs --table layers for it; plan needs no table");
}

BenchCases casesOf(const Options& options, const BenchOptions& bench) {
    Settings given = options.settings;
    given.camera = options.cameras.front();
    return makeBenchCases(options.scenes.front(), given, bench);
}

// The subject that outputs name: the scene, or the table if it has scenes of its own.
std::string subjectOf(const Options& options, BenchTable table) {
    if (table == BenchTable::growth) return "growth of frame time";
    if (table == BenchTable::layers) return "layers by what they cover";
    return options.scenes.front();
}

// --path X means --paths X if --paths is missing.
BenchOptions benchOptions(const Options& options) {
    BenchOptions bench = options.bench;
    if (bench.paths.empty() && options.path_given) bench.paths = {options.settings.path};
    return bench;
}

}  // namespace

int runBench(const Options& options) {
    checkBenchOptions(options);
    const BenchOptions requested = benchOptions(options);
    const BenchCases cases = casesOf(options, requested);
    const std::filesystem::path folder = outputFolder(options, "diptych-bench", "benchmark", benchManifest);
    if (options.debug_given) note(options, "--debug is not used: bench writes no image of a channel");
    if (!options.channels.empty()) note(options, "--channels is not used: bench writes no channels");

    Progress progress(progressOutput(options));
    std::optional<RegisterCounter> registers;
    if (!options.compile_on.empty()) registers.emplace(options.compile_on, deviceOptions(options));
    Device device(deviceOptions(options));
    say(options, "on " + device.info().name);
    Bench bench{subjectOf(options, requested.table),
                requested,
                reportDevice(device),
                options.runs,
                {},
                cases.skips,
                registers ? registers->info().name : ""};
    const auto print = [&](const std::string& text) { printLive(options, progress, text); };
    const Stage whole(progress, bench.scene);
    const auto groups = static_cast<double>(cases.groups.size());
    const std::shared_ptr<PipelineSet> pipelines = makePipelineSet(device);
    for (std::size_t i = 0; i < cases.groups.size(); ++i) {
        const BenchGroup& group = cases.groups[i];
        const double from = static_cast<double>(i) / groups, to = static_cast<double>(i + 1) / groups;
        const double read = from + 0.1 * (to - from);
        if (isHopeless(bench, group)) continue;
        const Scene scene = loadShown(group.scene, options.settings, whole.part(from, read));
        const std::size_t first = bench.rows.size();
        measureGroup(device, pipelines, group, scene, bench, whole.part(read, to));
        if (registers) registers->count(scene, std::span(bench.rows).subspan(first));
        // With --table layers, benchEnd() has a line for the three ways.
        if (requested.table != BenchTable::layers && bench.rows.size() > first)
            print(benchTable(bench, first));
    }
    checkValidation(device);
    const std::string json = writeBench(bench, folder, options.force);
    progress.wipe();
    if (options.json) printText(json);
    print(benchEnd(bench) + (folder / "index.html").string() + "\n");
    return 0;
}

}  // namespace diptych::cli
