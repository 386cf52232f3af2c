// SPDX-License-Identifier: MIT
#include "compare/cli/command_options.h"

#include "compare/audit/quantities.h"
#include "compare/audit/relations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::cli {
namespace {

const Command commands[] = {
    {"compare", "Renders a scene with both paths and compares every channel: table, pictures, verdict",
     "diptych compare helmet.glb --lights point:32 -o helmet-report",
     "gbuffer assign shadows lights camera size baseline tolerances out json"},
    {"render", "Renders one Frame: an EXR with every channel, and a PNG",
     "diptych render helmet.glb --path deferred --debug normals -o normals.png",
     "path debug channels lights shadows camera size time exposure out"},
    {"diff", "Compares any two EXR, PNG, JPEG, TIFF, HDR or PFM images from any renderer",
     "diptych diff reference.exr test.exr --metric flip --tolerance 0.01 -o difference",
     "metric tolerance failing channels map mask crop tolerances out json"},
    {"tradeoff", "Renders a scene with many Settings: time and error of each, and the Pareto front",
     "diptych tradeoff helmet.glb --size 320x180 -o helmet-tradeoff",
     "grid lights shadows camera size runs shard device out json"},
    {"explain", "Ranks the causes of a lit difference: which channels and Settings, by how much, and where",
     "diptych explain helmet.glb --gbuffer compact -o helmet-causes",
     "gbuffer test baseline scene lights camera size device out json"},
    {"choose",
     "Finds the fastest Settings within an error budget, or the most accurate within a time or memory budget",
     "diptych choose helmet.glb --max-error 0.02 -o helmet-choice",
     "max-error max-ms max-bytes figure grid lights size device out json"},
    {"audit", "Pushes scene and camera to numerical extremes and finds where each path breaks",
     "diptych audit helmet.glb --quantity near,fov",
     "quantity require shadows lights camera size device out force json"},
    {"plan", "Lists the features a scene needs and those left out, with reasons; passes and bytes",
     "diptych plan helmet.glb --gbuffer compact",
     "estimate compile-on gbuffer assign lights shadows msaa device json verbose"},
    {"view", "Opens a window with both paths live: wipe, differences, channels, verdict, pixel breakdown",
     "diptych view helmet.glb", "report watch debug baseline gbuffer lights shadows camera size device"},
    {"bench", "Times frames and passes of several Settings side by side",
     "diptych bench builtin:spheres --light-counts 16,256,4096 --assign every,clustered --runs 9",
     "table paths assign light-counts sizes kernels runs device out json"},
    {"calibrate", "Finds how another renderer interprets its inputs, from charts with a known result",
     "diptych calibrate three.json"},
    {"merge", "Merges the reports of shards, in any order, into one", "diptych merge shard-*/ -o report"},
    {"submit", "Runs a command over many scenes as a Slurm job array and merges the reports",
     "diptych submit slurm --shards 16 --at-once 4 -- compare scenes/ -o report"},
    {"accept", "Writes rules that accept the differences of a report",
     "diptych accept diptych-report Box.glb --channel lit -o accepted.json"},
    {"devices", "Lists Vulkan devices and what each can and cannot do here", "diptych devices"},
};

const char* const pixel_group = "Settings (may change a pixel)";
const char* const picture_group = "Channels and pictures";
const char* const output_group = "Output";
const char* const selection_group = "Comparison";
const char* const device_group = "Device and timing";

void addSettings(CLI::App& app, ParsedOptions& parsed, const std::string& except = "") {
    app.option_defaults()->group(pixel_group);
    const Settings defaults;
    for (const Field& field : settingFields()) {
        const std::string option(field.option);
        if (option == "camera" || option == except) continue;
        const std::string value = defaults.valueOf(option);
        app.add_option_function<std::string>(
               "--" + option,
               [&parsed, option](const std::string& words) { parsed.settings.emplace_back(option, words); },
               std::string(field.help) + (value.empty() ? "" : " (" + value + ")"))
            ->type_name(acceptedValues(option));
    }
    app.add_option("--camera", parsed.cameras,
                   std::string(settingField("camera").help) +
                       "; repeatable. A scene without a camera is seen from direction (+1, +0.6, +1), or "
                       "from another side or from inside if that shows clearly more")
        ->type_name("CAMERA")
        ->allow_extra_args(false);
    app.add_option_function<std::string>(
           "--sort", [&parsed](const std::string& words) { parsed.settings.emplace_back("sort", words); },
           "old name: on means --transparency sorted, off means unsorted")
        ->type_name("on|off");
    app.add_option("--settings", parsed.settings_file,
                   "Settings as JSON, as every report prints them; applied before other options")
        ->type_name("FILE.json");
    app.add_option("--frames", parsed.frames,
                   "number of pictures, numbered from 0000; the first is at --time (1)")
        ->type_name("N");
    app.add_option("--fps", parsed.fps, "pictures per second of --frames (30)")->type_name("F");
}

void addPicture(CLI::App& app, Options& options, ParsedOptions& parsed) {
    app.option_defaults()->group(picture_group);
    app.add_option("--debug", parsed.debug, "channel that the picture shows (lit)")->type_name("NAME|NUMBER");
    app.add_flag(
        "--heat", options.heat,
        "the picture shows the number of lights each pixel evaluates, with a legend; overrides --debug");
    app.add_option("--channels", parsed.channels,
                   "channels to render, separated by commas (all); render: one PNG each")
        ->type_name("NAME|NUMBER,...");
    app.add_flag("--list-channels", options.list_channels, "list all channels and exit");
    CLI::Option* exposure =
        app.add_option("--exposure", options.picture.exposure, "factor on the radiance, pictures only")
            ->type_name("F");
    CLI::Option* ev100 =
        app.add_option("--ev100", options.picture.ev100, "exposure value at ISO 100, pictures only")
            ->type_name("F")
            ->excludes(exposure);
    app.add_option("--match-exposure", options.match_exposure,
                   "use the automatic exposure of this EXR or HDR file")
        ->type_name("FILE")
        ->excludes(exposure)
        ->excludes(ev100);
    app.add_flag_callback(
        "--no-tonemap", [&options] { options.picture.tonemap = false; },
        "clip instead of tone mapping, pictures only");
}

ColorChoice colorOf(const std::string& word) {
    for (const auto& [name, choice] :
         {std::pair{"auto", ColorChoice::automatic}, {"on", ColorChoice::on}, {"off", ColorChoice::off}})
        if (word == name) return choice;
    throw std::runtime_error(fmt::format("--color {}: takes auto, on or off", word));
}

void addOutput(CLI::App& app, Options& options) {
    app.option_defaults()->group(output_group);
    app.add_flag("--json", options.json, "print the result as JSON on stdout, and nothing else");
    app.add_option_function<std::string>(
           "--color", [&options](const std::string& word) { options.color = colorOf(word); },
           "colours of verdicts (auto: on a terminal, unless NO_COLOR is set)")
        ->type_name("auto|on|off");
    CLI::Option* quiet = app.add_flag("-q,--quiet", options.quiet, "print only errors");
    app.add_flag("-v,--verbose", options.verbose, "print on stderr what is being done, and routine notes")
        ->excludes(quiet);
}

void addFiles(CLI::App& app, Options& options, const std::string& defaults) {
    app.option_defaults()->group(output_group);
    app.add_option("-o,--out", options.out, defaults)
        ->type_name("DIR|FILE")
        ->check([](const std::string& word) {
            return std::string(word.empty() ? "\"\" names no folder or file" : "");
        });
    app.add_flag("--force", options.force, "also replace files that diptych did not write");
}

// Selection of compared pixels.
void addSelection(CLI::App& app, SelectionOptions& selection, ParsedOptions& parsed) {
    app.option_defaults()->group(selection_group);
    app.add_option("--mask", selection.mask, "compare only pixels where this picture is at least half white")
        ->type_name("FILE");
    app.add_option("--ids", selection.ids, "compare only pixels with these material ids in the reference")
        ->type_name("ID,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--ignore-edges", selection.ignore_edges,
                   "exclude pixels within N pixels of another object")
        ->type_name("N")
        ->check(CLI::Range(0, 1000));
    app.add_option("--crop", parsed.crop, "compare only this rectangle; X,Y from the top left")
        ->type_name("X,Y,WxH");
}

void addTolerances(CLI::App& app, Options& options) {
    app.option_defaults()->group(selection_group);
    app.add_flag("--strict", options.strict,
                 "make failures of these notes: a channel on only one side, a colour profile or pixel aspect "
                 "that is not applied, an empty picture");
    app.add_flag(
        "--allow-empty", options.allow_empty,
        "no warning about pictures that are black, empty, or show the scene on less than 1 % of the pixels");
    app.add_option("--tolerances", options.tolerances,
                   "rules for allowed differences, see compare/verdict/tolerances.schema.json")
        ->type_name("FILE.json");
}

void addDiff(CLI::App& app, PictureDiffOptions& diff, ParsedOptions& parsed) {
    app.option_defaults()->group(selection_group);
    app.add_option("--metric", parsed.metric,
                   "metric for the verdict: flip, rmse, max, relative, psnr, ssim, ulp, ... (flip)")
        ->type_name("NAME");
    app.add_option(
           "--tolerance", parsed.tolerance,
           "largest metric value that passes; for psnr and ssim the smallest (only equal images pass)")
        ->type_name("T");
    app.add_option("--warn", diff.warn, "warn beyond this value")->type_name("T");
    app.add_option("--failing", diff.failing,
                   "instead of --metric: fraction of pixels whose error may exceed the tolerance")
        ->type_name("SHARE")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--channels", diff.channels, "names of the channels to compare, * and ? allowed (all)")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--map", diff.names, "Diptych's names for another renderer's channels; repeatable")
        ->type_name("NAME=CHANNEL,...")
        ->allow_extra_args(false);
    app.add_option("--blur", diff.blur, "blur both pictures first, standard deviation in pixels (0)")
        ->type_name("PIXELS")
        ->check(CLI::Range(0.0, 100.0));
    app.add_option("--shift", diff.shift, "allow features to move by up to this many pixels (0)")
        ->type_name("PIXELS")
        ->check(CLI::Range(0, 16));
    app.add_option("--ppd", diff.flip.pixels_per_degree, "FLIP: pixels per degree of the view (67.0206)")
        ->type_name("F");
    app.add_option("--start-exposure", diff.flip.start_exposure,
                   "HDR-FLIP: the darkest exposure, stops (from the reference)")
        ->type_name("STOPS");
    app.add_option("--stop-exposure", diff.flip.stop_exposure, "HDR-FLIP: the brightest exposure, stops")
        ->type_name("STOPS");
    app.add_option("--exposures", diff.flip.exposures, "HDR-FLIP: number of exposures")
        ->type_name("N")
        ->check(CLI::Range(1, 1000));
}

// Hides options that the command accepts and ignores. They are accepted so that one option line works for
// several commands.
void hide(CLI::App& app, std::initializer_list<const char*> options) {
    for (const char* option : options)
        if (CLI::Option* found = app.get_option_no_throw(option)) found->group("");
}

void hideGroup(CLI::App& app, const std::string& group) {
    for (CLI::Option* option : app.get_options())
        if (option->get_group() == group) option->group("");
}

void hideUnread(CLI::App& app, const std::string& command) {
    if (command != "render") hide(app, {"--frames", "--fps"});
    if (command == "view")
        hide(app, {"--runs", "--channels", "--times", "--renderer", "--single-file", "--keep",
                   "--update-baseline", "--explain", "--force", "--json", "--strict", "--allow-empty"});
    if (command == "compare") {
        hide(app, {"--debug", "--heat"});
        app.get_option("--path")->description("path that --update-baseline writes (the file's own)");
    }
    if (command == "bench" || command == "tradeoff" || command == "choose" || command == "explain")
        hide(app, {"--debug", "--heat", "--channels", "--list-channels"});
    if (command == "explain") {
        hide(app, {"--path", "--runs"});
    }
    if (command == "bench" || command == "choose" || command == "audit") hideGroup(app, picture_group);
    if (command == "choose" || command == "audit") hide(app, {"--path", "--runs"});
    if (command == "devices" || command == "plan") {
        hideGroup(app, picture_group);
        hide(app, {"--out", "--force", "--runs"});
    }
    if (command == "devices") hideGroup(app, pixel_group);
}

// Selection of scenes.
void addShard(CLI::App& app, Options& options) {
    app.option_defaults()->group(output_group);
    app.add_option("--shard", options.shard,
                   "render one part of the scenes: the I-th of N, from 1; slurm: the task of a Slurm array "
                   "(slurm/N if its indices are irregular). merge joins the reports")
        ->type_name("I/N|slurm[/N]");
    app.add_option("--timings", options.timings,
                   "earlier report with the scenes' times, to balance shards (by file size)")
        ->type_name("DIR|report.json");
}

void addSince(CLI::App& app, Options& options) {
    app.option_defaults()->group(output_group);
    app.add_option("--since", options.since,
                   "earlier report to compare with: new failures, fixed failures, and metrics that changed "
                   "by more than their noise")
        ->type_name("DIR|report.json");
}

// Settings that a sweep tries.
void addGrid(CLI::App& app, Options& options, const char* defaults) {
    app.add_option(
           "--grid", options.grid,
           fmt::format(
               "Settings to try: {{ \"settings\": {{ \"gbuffer\": [\"compact\", \"full\"], \"size\": "
               "[\"1/2\"] }} }} tries every combination; a list of such objects tries each in turn ({})",
               defaults))
        ->type_name("FILE.json|JSON");
}

void addChoose(CLI::App& app, ChooseOptions& choose, ParsedOptions& parsed) {
    app.option_defaults()->group("Budgets (one or two)");
    app.add_option("--max-error", choose.max_error,
                   "largest error of lit; finds the fastest Settings within it")
        ->type_name("E");
    app.add_option("--figure", choose.figure, "error metric of --max-error (flip)")
        ->type_name("flip|relative_rmse|relative_p99");
    app.add_option("--max-ms", choose.max_ms,
                   "longest frame time, ms; without --max-error, finds the most accurate Settings within it")
        ->type_name("T");
    app.add_option("--max-bytes", parsed.max_bytes,
                   "largest memory of a frame: bytes, or a number with KiB, MiB or GiB")
        ->type_name("B");
    app.add_flag("--explain-choice", choose.explain,
                 "explain the choice of path: the effect of overdraw, lights per pixel, transparency, "
                 "samples, materials, triangles and size, and the value at which each would reverse the "
                 "choice; renders a few hundred more frames");
}

std::string namesOf(const auto& all) {
    std::vector<std::string_view> names;
    for (const auto& each : all) names.push_back(each.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

void addAudit(CLI::App& app, AuditOptions& audit, ParsedOptions& parsed) {
    app.option_defaults()->group("Stress test");
    app.add_option("--quantity", audit.quantities,
                   fmt::format("quantities to push (all): {}. Defaults: --size 160x90; --shadows off, except "
                               "for shadow quantities",
                               namesOf(audit::quantities())))
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--require", parsed.require,
                   "exit code 1 if a path's error reaches 1e-2 between the original scene and this "
                   "magnitude; repeatable")
        ->type_name("NAME=MAGNITUDE,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_flag("--relations", audit.relations,
                 "instead of pushing quantities, test changes that must not change the picture, on this "
                 "device, without a reference; exit code 1 if a relation is broken");
    app.add_option("--relation", audit.chosen_relations,
                   fmt::format("relations to test (all): {}", namesOf(audit::relations())))
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false);
}

// Contents of a report.
void addReport(CLI::App& app, Options& options, ParsedOptions& parsed) {
    app.option_defaults()->group(output_group);
    app.add_option("--keep", parsed.keep, "comparisons whose pictures and EXRs the report keeps (all)")
        ->type_name("all|failing|none");
    app.add_flag("--single-file", options.single_file,
                 "embed the pictures in the page at half size; other files only for CI");
}

void addView(CLI::App& app, ViewOptions& view) {
    app.option_defaults()->group("View");
    app.add_option("--report", view.report,
                   "open a report of compare at the worst pixel of its first failing channel; --debug "
                   "selects another channel, SCENE another scene")
        ->type_name("DIR");
    app.add_flag("--watch", view.watch, "reload the scene when its files change on disk");
    app.get_option("--pixel")->description("pixel to inspect first");
}

// Options of bench; every list is comma-separated.
void addBench(CLI::App& app, ParsedOptions& parsed) {
    app.option_defaults()->group("Benchmark");
    app.add_option("--table", parsed.bench_table,
                   "modes: every mode; msaa: each path by samples per pixel, with and without blended "
                   "surfaces, and its memory; growth: each path as one quantity grows (modes)")
        ->type_name("modes|msaa|growth");
    app.add_option(
           "--axes", parsed.bench_axes,
           "quantities of --table growth: triangles, draws, instances, textures, lights, pixels (all)")
        ->type_name("AXIS,...");
    app.add_option("--paths", parsed.bench_paths, "paths to time (deferred,forward_plus)")
        ->type_name("PATH,...");
    app.add_option("--assign", parsed.bench_assign, "light assignments to time (all supported)")
        ->type_name(acceptedValues("assign") + ",...");
    app.add_option("--sizes", parsed.bench_sizes, "picture sizes to time (--size)")->type_name("WxH,...");
    app.add_option("--transparencies", parsed.bench_transparencies,
                   "orderings of blended surfaces to time (--transparency)")
        ->type_name(acceptedValues("transparency") + ",...");
    app.add_option("--lightings", parsed.bench_lightings, "G-buffer shading methods to time (--lighting)")
        ->type_name(acceptedValues("lighting") + ",...");
    app.add_option("--light-counts", parsed.light_counts,
                   "light counts to time: of builtin:spheres, of a --lights file with {} in its name, or of "
                   "a seeded rig (the scene's own lights)")
        ->type_name("N,...");
    app.add_option("--max-ms", parsed.max_ms,
                   "longer frames are not repeated or tried with more lights, ms (2000)")
        ->type_name("T");
    app.add_option("--kernels", parsed.kernels,
                   "also time one light at one pixel against hand-written AVX2: on, off, or only that (on)")
        ->type_name("on|off|only");
}

// External renderers.
void addRenderers(CLI::App& app, ParsedOptions& parsed, const char* what) {
    app.add_option(
           "--renderer", parsed.renderers,
           fmt::format(
               "{}; repeatable. The file gives its command, see compare/external/renderer.schema.json", what))
        ->type_name("NAME=FILE.json")
        ->allow_extra_args(false)
        ->group(picture_group);
}

// Settings of one path only.
void addSides(CLI::App& app, ParsedOptions& parsed) {
    for (std::size_t side = 0; side < drawn_paths.size(); ++side)
        app.add_option(sideOption(drawn_paths.at(side)), parsed.sides.at(side),
                       fmt::format("Settings of {} only, for example assign=every,shadows=off",
                                   nameOf(drawn_paths.at(side))))
            ->type_name("NAME=VALUE,...")
            ->allow_extra_args(false)
            ->group(pixel_group);
}

void addDevice(CLI::App& app, Options& options) {
    app.option_defaults()->group(device_group);
    app.add_option("--device", options.device,
                   "index or part of a name, see diptych devices (a GPU if there is one)")
        ->type_name("INDEX|NAME");
    app.add_flag("--validate", options.validate,
                 "run under the Vulkan validation layers; any message is a failure");
}

}  // namespace

std::span<const Command> allCommands() {
    return commands;
}

std::size_t hideSeldomUsed(CLI::App& app, const Command& command) {
    if (command.most_used.empty()) return 0;
    const std::string names = " " + command.most_used + " ";
    std::size_t hidden = 0;
    for (CLI::Option* option : app.get_options()) {
        if (option->get_group().empty() || option->get_positional() || option == app.get_help_ptr()) continue;
        const bool shown = std::ranges::any_of(option->get_lnames(), [&](const std::string& name) {
            return names.find(" " + name + " ") != names.npos;
        });
        if (shown) continue;
        option->group("");
        ++hidden;
    }
    return hidden;
}

namespace {

// CLI11 accepts C literals: "0x10" would mean 16.
void refuseHexadecimals(CLI::App& app) {
    constexpr std::array<std::string_view, 9> numbers{"F",      "N",     "K",     "T",     "E",
                                                      "PIXELS", "STOPS", "SHARE", "ID,..."};
    for (CLI::Option* option : app.get_options())
        if (std::ranges::count(numbers, option->get_type_name()) > 0)
            option->check([](const std::string& word) {
                return word.find_first_of("xX") == word.npos
                           ? std::string()
                           : word + " is not a decimal number; write for example 0.5";
            });
}

void addAll(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed) {
    if (command == "devices") {
        addSettings(app, parsed);
        addPicture(app, options, parsed);
        addDevice(app, options);
        app.add_flag("--probe", options.probe,
                     "run the shaders' functions on millions of inputs and compare them with double "
                     "precision, in ULP; exit code 1 if an error exceeds Vulkan's limit");
        addFiles(app, options, "not accepted: devices writes no file; use --json");
        return addOutput(app, options);
    }

    if (command == "calibrate") {
        app.add_option("renderer", options.scenes, "file that gives the renderer's command")
            ->type_name("FILE.json")
            ->expected(1)
            ->required();
        addFiles(app, options, "not accepted: calibrate writes no file; use --json");
        return addOutput(app, options);
    }

    if (command == "diff") {
        app.add_option("images", options.scenes, "reference and test image")
            ->type_name("A B")
            ->expected(2)
            ->required();
        addDiff(app, options.diff, parsed);
        addSelection(app, options.diff.selection, parsed);
        addTolerances(app, options);
        addReport(app, options, parsed);
        addFiles(app, options,
                 "X.exr: errors of every channel; X.png: errors of the deciding channel; any other name: "
                 "report folder; without -o: no files");
        return addOutput(app, options);
    }

    if (command == "submit") {
        app.add_option("engine", options.submit.engine, "job system")->type_name("slurm")->required();
        app.add_option("--shards", options.submit.shards,
                       "number of shards to split the scenes into (one per scene, at most 16)")
            ->type_name("N")
            ->check(CLI::Range(1, 1000000));
        app.add_option("--at-once", options.submit.at_once, "number of shards that run at a time (no limit)")
            ->type_name("K")
            ->check(CLI::Range(1, 1000000));
        app.add_option("--sbatch", options.submit.options,
                       "sbatch option for the shards, such as --sbatch=--partition=long; repeatable")
            ->type_name("OPTION")
            ->allow_extra_args(false);
        app.add_flag("--dry-run", options.submit.dry_run, "print both scripts; write and submit nothing");
        addFiles(app, options, "not accepted: give -o to the command after --");
        return addOutput(app, options);
    }
    if (command == "accept") {
        app.add_option("report", options.scenes, "a report, and one of its scenes (all failing ones)")
            ->type_name("DIR [SCENE]");
        app.add_option("--channel", options.accept.channel, "channel to accept (all failing ones)")
            ->type_name("NAME");
        app.add_option("--because", options.accept.because, "reason, which reports print")->type_name("TEXT");
        addFiles(app, options, "rules file to extend (accepted.json)");
        return addOutput(app, options);
    }
    if (command == "merge") {
        app.add_option("folders", options.scenes, "report folders of all shards")->type_name("DIR...");
        addFiles(app, options, "report folder (diptych-report)");
        addSince(app, options);
        return addOutput(app, options);
    }

    app.add_option("scenes", options.scenes, "glTF files, or builtin:NAME (builtin:gallery)")
        ->type_name("SCENE...");
    if (command == "compare" || command == "tradeoff" || command == "choose")
        app.get_option("scenes")->description(
            "glTF files, builtin:NAME, folders, patterns as 'scenes/**/*.glb', lists as @scenes.txt "
            "(builtin:gallery)");
    addSettings(app, parsed, command == "bench" ? "assign" : "");
    addPicture(app, options, parsed);
    addDevice(app, options);
    app.add_option("--runs", parsed.runs,
                   fmt::format("timed frames; 0 measures no time ({})", defaultRuns(command)))
        ->type_name("N");

    if (command == "compare" || command == "explain")
        app.add_option(
               "--against-device", options.against_device,
               command == "compare"
                   ? "also render each path on this device, and compare it with the same path on --device"
                   : "render the baseline's path on this device too, and explain the difference")
            ->type_name("INDEX|NAME")
            ->group(device_group);

    if (command == "compare" || command == "explain" || command == "view") addSides(app, parsed);

    // view accepts every option of compare, so that one option line works for both.
    if (command == "compare" || command == "view") {
        app.add_option("--times", parsed.times, "several animation times in one report, seconds (--time)")
            ->type_name("S,S,...")
            ->group(pixel_group)
            ->excludes(app.get_option("--time"));
        addFiles(app, options,
                 command == "view" ? "folder for the files that the key P writes (the current one)"
                                   : "report folder (diptych-report)");
        app.add_option("--baseline", parsed.baseline,
                       "left panel: deferred or forward_plus; with reference or an EXR, both paths are "
                       "compared with it (deferred)")
            ->type_name("PATH|FILE.exr");
        addRenderers(app, parsed, "another renderer to compare with the left panel");
        addReport(app, options, parsed);
        if (command == "compare") addShard(app, options);
        if (command == "compare") addSince(app, options);
        app.add_flag("--update-baseline", options.update_baseline,
                     "replace the --baseline FILE.exr; the old one stays as FILE.exr.old");
        addSelection(app, options.selection, parsed);
        addTolerances(app, options);
        app.add_option("--twice", parsed.twice,
                       "channels to render a second time; a difference between the two runs is a race (lit)")
            ->type_name("all|lit|none");
        app.add_flag("--allow-noise", options.allow_noise,
                     "on a GPU, add the difference between two runs of one path to its tolerance");
        app.add_flag("--explain", options.explain, "name the causes of a lit difference even if it passes")
            ->group(output_group);
        app.option_defaults()->group(output_group);
        app.add_option("--pixel", parsed.pixel,
                       "instead of a report, print one pixel's breakdown: both surfaces, each light's term, "
                       "the first step that differs; exit code 0 if that succeeds")
            ->type_name("X,Y");
        if (command == "view") addView(app, options.view);
    } else if (command == "render") {
        addFiles(
            app, options,
            "X.exr: every channel; X.png: the picture; any other name: a folder with both (diptych-render)");
        app.add_flag("--list-scenes", options.list_scenes, "list the built-in scenes and exit");
    } else if (command == "tradeoff") {
        addFiles(app, options, "folder for the page, table and plots (diptych-tradeoff)");
        addShard(app, options);
        addGrid(app, options, "each Setting alone, and declared pairs");
        addRenderers(app, parsed, "another renderer to add as a row");
    } else if (command == "choose") {
        addFiles(app, options,
                 "X.json: the chosen Settings (several scenes: one choice for all); any other name: folder "
                 "with a page, choice.json and settings.json; without -o: no files");
        addGrid(app, options, "each Setting alone, and helpful combinations");
    } else if (command == "explain") {
        addFiles(app, options, "folder for the page, maps and JSON; without -o: no files");
        app.add_option("--baseline", parsed.baseline, "picture taken as correct (deferred)")
            ->type_name("deferred|forward_plus");
        addRenderers(app, parsed, "another renderer as the second picture");
        app.add_option("--scene", options.scene_file, "scene of two EXR files, if they do not name it")
            ->type_name("FILE");
        app.get_option("scenes")->description(
            "a glTF file or builtin:NAME (builtin:gallery); or two EXR files");
        app.add_option(
               "--test", parsed.test,
               "Setting of the second picture, such as gbuffer=compact; repeatable (path: the other path)")
            ->type_name("NAME=VALUE")
            ->allow_extra_args(false);
    } else if (command == "bench") {
        addFiles(app, options, "folder for the page, table and plot (diptych-bench)");
    } else {
        addFiles(app, options,
                 command == "plan" ? "not accepted: plan writes no file; use --json" : "output folder");
        if (command == "plan") {
            app.add_flag("--estimate", options.estimate,
                         "render the frames, count their workload, and estimate their time on some GPUs")
                ->group("Plan");
            app.add_option("--compile-on", options.compile_on,
                           "compile each pipeline for this device and print the compiler's statistics: index "
                           "or part of a name, or an AMD GPU family (vega10, navi21, navi31, gfx1201, ...), "
                           "for which RADV of Mesa 25 compiles without the GPU")
                ->type_name("DEVICE")
                ->group("Plan");
        }
    }
    if (command == "bench") addBench(app, parsed);
    addOutput(app, options);
    if (command == "choose") addChoose(app, options.choose, parsed);
    if (command == "audit") {
        addAudit(app, options.audit, parsed);
        app.get_option("--size")->description("picture size, WxH (160x90)");
        app.get_option("--shadows")->description("shadow technique (off, except for shadow quantities)");
    }
}

}  // namespace

void describe(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed) {
    addAll(app, command, options, parsed);
    refuseHexadecimals(app);
    hideUnread(app, command);
}

}  // namespace diptych::cli
