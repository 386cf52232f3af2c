// SPDX-License-Identifier: MIT
#include "compare/bench/bench.h"
#include "compare/bench/registers.h"
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/run/print.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <span>

namespace diptych::cli {

using namespace bench;

namespace {

struct BenchLine : SceneGroup, BenchOptions {
    std::string compile_on;  // a device or GPU family; empty: none
    std::string table_text = "modes", kernels = "off";
    std::map<std::string, std::string> lists;  // words of options that readList() reads
};

void describeBench(CLI::App& app, BenchLine& options) {
    options.runs = 5;
    addScene(app, options, one_scene_help, "assign");
    addFiles(app, options, "folder for the page, table and plot (diptych-bench)");
    app.option_defaults()->group("Benchmark");
    const auto addWords = [&](const char* option, const std::string& type, const std::string& help) {
        addOption(app, option, options.lists[option], type, help);
    };
    addOption(app, "--table", options.table_text, "modes|msaa|growth|layers",
              "modes: every mode; msaa: each path by samples per pixel, with and without blended surfaces, "
              "and its memory; growth: each path as one quantity grows; layers: forward+ and both --layers "
              "of deferred by what coats, sheen, brushed surfaces and glass cover (modes)");
    addWords("--axes", "AXIS,...", fmt::format("quantities of --table growth: {} (all)", growthAxisNames()));
    addWords("--paths", "PATH,...", "paths to time (deferred,forward_plus)");
    addWords("--assign", acceptedValues("assign") + ",...", "light assignments to time (all supported)");
    addWords("--sizes", "WxH,...", "picture sizes to time (--size)");
    addWords("--transparencies", acceptedValues("transparency") + ",...",
             "orderings of blended surfaces to time (--transparency)");
    addWords("--lightings", acceptedValues("lighting") + ",...",
             "G-buffer shading methods to time (--lighting)");
    addWords("--light-counts", "N,...",
             "light counts to time: of builtin:spheres, of a --lights file with {} in its name, or of a "
             "seeded rig (the scene's own lights; --table layers: 1,64,1024)");
    addOption(app, "--max-ms", options.max_ms, "T",
              "longer frames are not repeated or tried with more lights, ms (2000)");
    app.add_option("--kernels", options.kernels);  // kept for scripts that switch them off
    addCompileOn(app, options.compile_on,
                 "--table layers: also the registers of shading, from this device's compiler", "Benchmark");
    addOutput(app, options);
    acceptUnread(app, {"--kernels"});
    acceptUnread(app, image_group);
}

void resolveBench(BenchLine& options) {
    resolveScene(options);
    for (const char* list :
         {"--paths", "--assign", "--sizes", "--transparencies", "--lightings", "--light-counts", "--axes"})
        readList(options, list, options.lists[list]);
    if (!(options.max_ms > 0) || !std::isfinite(options.max_ms))
        refuse("--max-ms {}: must be above 0 and finite", options.max_ms);
    if (options.kernels != "off")
        refuse("--kernels {}: bench times frames alone; build/tests/bench_kernels times the kernels",
               options.kernels);
    options.table = benchTableOf(options.table_text);
}

void checkBenchOptions(const BenchLine& options) {
    if (options.scenes.size() != 1)
        refuse("{}: bench takes one scene; run it once for each", options.scenes[1]);
    if (options.cameras.size() != 1) refuse("--camera: bench takes one camera; run it once for each");
    if (options.runs < 1) refuse("--runs 0: bench measures times; use 1 or more");
    if (isReference(options.settings.path))
        refuse("--path reference: bench does not time the reference; use deferred or forward_plus");
    if (!options.compile_on.empty() && options.table != BenchTable::layers)
        refuse("--compile-on: bench needs --table layers for it; plan needs no table");
}

BenchCases casesOf(const BenchLine& options, const BenchOptions& bench) {
    Settings requested = options.settings;
    requested.camera = options.cameras.front();
    return makeBenchCases(options.scenes.front(), requested, bench);
}

// The subject that outputs name: the scene, or the table if it has scenes of its own.
std::string subjectOf(const BenchLine& options, BenchTable table) {
    if (table == BenchTable::growth) return "growth of frame time";
    if (table == BenchTable::layers) return "layers by what they cover";
    return options.scenes.front();
}

// --path X means --paths X if --paths is missing.
BenchOptions benchOptions(const BenchLine& options) {
    BenchOptions bench = options;
    if (bench.paths.empty() && options.path_requested) bench.paths = {options.settings.path};
    return bench;
}

int runBench(const BenchLine& options) {
    checkBenchOptions(options);
    const BenchOptions requested = benchOptions(options);
    const BenchCases cases = casesOf(options, requested);
    const std::filesystem::path folder = outputFolder(options, "diptych-bench", "benchmark", benchManifest);
    if (options.debug_requested) note(options, "--debug is not used: bench writes no image of a channel");
    if (!options.channels.empty()) note(options, "--channels is not used: bench writes no channels");

    Progress progress(progressOutput(options));
    std::optional<RegisterCounter> registers;
    if (!options.compile_on.empty()) registers.emplace(options.compile_on, deviceOptions(options));
    Device device(deviceOptions(options));
    logVerbose(options, "on " + device.info().name);
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
        const Scene scene = loadSceneWithSettings(group.scene, options.settings, whole.part(from, read));
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

}  // namespace

Command benchCommand() {
    return makeCommand<BenchLine>(
        {"bench", "Times frames and passes of several Settings side by side",
         "diptych bench builtin:spheres --light-counts 16,256,4096 --assign every,clustered --runs 9",
         "table paths assign light-counts sizes shadows runs device out json"},
        describeBench, resolveBench, runBench);
}

}  // namespace diptych::cli
