// SPDX-License-Identifier: MIT
#include "compare/cli/option_groups.h"

#include "compare/audit/quantities.h"
#include "compare/audit/relations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::cli {
namespace {

ColorChoice colorOf(const std::string& word) {
    for (const auto& [name, choice] :
         {std::pair{"auto", ColorChoice::automatic}, {"on", ColorChoice::on}, {"off", ColorChoice::off}})
        if (word == name) return choice;
    throw std::runtime_error(fmt::format("--color {}: takes auto, on or off", word));
}

std::string namesOf(const auto& all) {
    std::vector<std::string_view> names;
    for (const auto& each : all) names.push_back(each.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void addSettings(CLI::App& app, ParsedOptions& parsed, const std::string& except) {
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

void addSelection(CLI::App& app, SelectionOptions& selection, ParsedOptions& parsed) {
    app.option_defaults()->group(selection_group);
    app.add_option("--mask", selection.mask,
                   "compare only pixels that are white in this picture: a colour component is at least half "
                   "(128 of 255, or 0.5), whatever the alpha")
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
    app.add_flag(
        "--strict", options.strict,
        "make failures of these notes: a channel on only one side, a file that is read in part, a colour "
        "profile or pixel aspect that is not applied, an empty picture, a large error that is granted");
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
           "largest metric value that passes; for psnr and ssim the smallest (none: only equal values pass)")
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

void addBench(CLI::App& app, ParsedOptions& parsed) {
    app.option_defaults()->group("Benchmark");
    app.add_option("--table", parsed.bench_table,
                   "modes: every mode; msaa: each path by samples per pixel, with and without blended "
                   "surfaces, and its memory; growth: each path as one quantity grows; layers: forward+ and "
                   "both --layers of deferred by what coats, sheen, brushed surfaces and glass cover (modes)")
        ->type_name("modes|msaa|growth|layers");
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
                   "a seeded rig (the scene's own lights; --table layers: 1,64,1024)")
        ->type_name("N,...");
    app.add_option("--max-ms", parsed.max_ms,
                   "longer frames are not repeated or tried with more lights, ms (2000)")
        ->type_name("T");
    app.add_option("--kernels", parsed.kernels)->group("");  // kept for scripts that switch them off
}

void addRenderers(CLI::App& app, ParsedOptions& parsed, const char* what) {
    app.add_option(
           "--renderer", parsed.renderers,
           fmt::format(
               "{}; repeatable. The file gives its command, see compare/external/renderer.schema.json", what))
        ->type_name("NAME=FILE.json")
        ->allow_extra_args(false)
        ->group(picture_group);
}

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

}  // namespace diptych::cli
