// SPDX-License-Identifier: MIT
#include "compare/cli/command_options.h"

#include "compare/cli/option_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <string_view>

namespace diptych::cli {
namespace {

const Command command_table[] = {
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
     "table paths assign light-counts sizes shadows runs device out json"},
    {"calibrate", "Finds how another renderer interprets its inputs, from charts with a known result",
     "diptych calibrate three.json"},
    {"merge", "Merges the reports of shards, in any order, into one", "diptych merge shard-*/ -o report"},
    {"submit", "Runs a command over many scenes as a Slurm job array and merges the reports",
     "diptych submit slurm --shards 16 --at-once 4 -- compare scenes/ -o report"},
    {"accept", "Writes rules that accept the differences of a report",
     "diptych accept diptych-report Box.glb --channel lit -o accepted.json"},
    {"devices", "Lists Vulkan devices and what each can and cannot do here", "diptych devices"},
};

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

void addDevices(CLI::App& app, Options& options, ParsedOptions& parsed) {
    addSettings(app, parsed);
    addPicture(app, options, parsed);
    addDevice(app, options);
    app.add_flag("--probe", options.probe,
                 "run the shaders' functions on millions of inputs and compare them with double "
                 "precision, in ULP; exit code 1 if an error exceeds Vulkan's limit");
    addFiles(app, options, "not accepted: devices writes no file; use --json");
}

void addCalibrate(CLI::App& app, Options& options) {
    app.add_option("renderer", options.scenes, "file that gives the renderer's command")
        ->type_name("FILE.json")
        ->expected(1)
        ->required();
    addFiles(app, options, "not accepted: calibrate writes no file; use --json");
}

void addDiffCommand(CLI::App& app, Options& options, ParsedOptions& parsed) {
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
}

void addSubmit(CLI::App& app, Options& options) {
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
}

void addAccept(CLI::App& app, Options& options) {
    app.add_option("report", options.scenes, "a report, and one of its scenes (all failing ones)")
        ->type_name("DIR [SCENE]");
    app.add_option("--channel", options.accept.channel, "channel to accept (all failing ones)")
        ->type_name("NAME");
    app.add_option("--because", options.accept.because, "reason, which reports print")->type_name("TEXT");
    addFiles(app, options, "rules file to extend (accepted.json)");
}

void addMerge(CLI::App& app, Options& options) {
    app.add_option("folders", options.scenes, "report folders of all shards")->type_name("DIR...");
    addFiles(app, options, "report folder (diptych-report)");
    addSince(app, options);
}

// view accepts every option of compare, so that one option line works for both.
void addCompareOrView(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed) {
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
}

void addExplain(CLI::App& app, Options& options, ParsedOptions& parsed) {
    addFiles(app, options, "folder for the page, maps and JSON; without -o: no files");
    app.add_option("--baseline", parsed.baseline, "picture taken as correct (deferred)")
        ->type_name("deferred|forward_plus");
    addRenderers(app, parsed, "another renderer as the second picture");
    app.add_option("--scene", options.scene_file, "scene of two EXR files, if they do not name it")
        ->type_name("FILE");
    app.get_option("scenes")->description("a glTF file or builtin:NAME (builtin:gallery); or two EXR files");
    app.add_option(
           "--test", parsed.test,
           "Setting of the second picture, such as gbuffer=compact; repeatable (path: the other path)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
}

void addCompileOn(CLI::App& app, Options& options, const char* what, const char* group) {
    app.add_option("--compile-on", options.compile_on,
                   fmt::format("{}: index or part of a name, or an AMD GPU family (vega10, navi21, navi31, "
                               "gfx1201, ...), for which RADV of Mesa 25 compiles without the GPU",
                               what))
        ->type_name("DEVICE")
        ->group(group);
}

void addPlan(CLI::App& app, Options& options) {
    addFiles(app, options, "not accepted: plan writes no file; use --json");
    app.add_flag("--estimate", options.estimate,
                 "render the frames, count their workload, and estimate their time on some GPUs")
        ->group("Plan");
    addCompileOn(app, options, "compile each pipeline for this device and print the compiler's statistics",
                 "Plan");
}

void addSceneCommand(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed) {
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

    if (command == "compare" || command == "view") {
        addCompareOrView(app, command, options, parsed);
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
        addExplain(app, options, parsed);
    } else if (command == "bench") {
        addFiles(app, options, "folder for the page, table and plot (diptych-bench)");
        addBench(app, parsed);
        addCompileOn(app, options,
                     "--table layers: also the registers of shading, from this device's compiler",
                     "Benchmark");
    } else if (command == "plan") {
        addPlan(app, options);
    } else {
        addFiles(app, options, "output folder");
    }
    addOutput(app, options);
    if (command == "choose") addChoose(app, options.choose, parsed);
    if (command == "audit") {
        addAudit(app, options.audit, parsed);
        app.get_option("--size")->description("picture size, WxH (160x90)");
        app.get_option("--shadows")->description("shadow technique (off, except for shadow quantities)");
    }
}

void addAll(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed) {
    if (command == "devices")
        addDevices(app, options, parsed);
    else if (command == "calibrate")
        addCalibrate(app, options);
    else if (command == "diff")
        addDiffCommand(app, options, parsed);
    else if (command == "submit")
        addSubmit(app, options);
    else if (command == "accept")
        addAccept(app, options);
    else if (command == "merge")
        addMerge(app, options);
    else
        return addSceneCommand(app, command, options, parsed);
    addOutput(app, options);
}

}  // namespace

std::span<const Command> allCommands() {
    return command_table;
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

void describe(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed) {
    addAll(app, command, options, parsed);
    refuseHexadecimals(app);
    hideUnread(app, command);
}

}  // namespace diptych::cli
