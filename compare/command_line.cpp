// SPDX-License-Identifier: MIT
#include "compare/command_line.h"

#include "compare/version.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace diptych {
namespace {

// name, what it does, an example, and whether it can be run
struct Command {
    std::string name, does, example;
    bool built;
};
const Command commands[] = {
    {"compare", "Draws a scene through both paths and compares every channel: table, pictures, verdict",
     "diptych compare helmet.glb --lights point:32 -o helmet-report", true},
    {"render", "Draws one Frame: an EXR with every channel, and a PNG",
     "diptych render helmet.glb --path deferred --debug normals -o normals.png", true},
    {"diff", "Compares any two EXR, PNG, HDR or PFM images, whoever rendered them",
     "diptych diff reference.exr test.exr --metric flip --tolerance 0.01 -o difference", true},
    {"tradeoff", "Time against error over many Settings", "diptych tradeoff helmet.glb", false},
    {"choose", "The path and Settings for an error budget or a time budget",
     "diptych choose helmet.glb --max-ms 8", false},
    {"audit", "Pushes scene and camera to numerical extremes", "diptych audit helmet.glb --quantity near,fov",
     false},
    {"plan", "What a scene needs modelled, what is left out and why; passes and bytes",
     "diptych plan helmet.glb --gbuffer compact", true},
    {"view", "A window with both paths live", "diptych view helmet.glb", false},
    {"bench", "Frame and pass times of several Settings side by side",
     "diptych bench helmet.glb --paths deferred,forward_plus --runs 20", false},
    {"devices", "Vulkan devices and what each can and cannot do here", "diptych devices", true},
};

// What was said, before it has a meaning.
struct Said {
    std::vector<std::pair<std::string, std::string>> settings;  // in the order of the command line
    std::vector<std::string> cameras;
    std::string settings_file, channels, debug;
    std::string baseline = "deferred", crop, metric;
    std::optional<double> tolerance;
    std::vector<std::string> not_built;  // options that parse but cannot be done
    int frames = 1;
    double fps = 30;
};

const char* const pixel_group = "What may change a pixel (a value that is not built yet is refused by name)";
const char* const picture_group = "Channels and pictures";
const char* const output_group = "Output";
const char* const selection_group = "What counts";
const char* const device_group = "Device and timing";
const char* const later_group = "Not built yet";

// An option of the contract that cannot be done yet.
void addLater(CLI::App& app, Said& said, const std::string& option, const std::string& type,
              const std::string& help) {
    app.add_option_function<std::string>(
           option,
           [&said, option](const std::string& value) { said.not_built.push_back(option + " " + value); },
           help)
        ->type_name(type)
        ->group(later_group);
}
void addLaterFlag(CLI::App& app, Said& said, const std::string& option, const std::string& help) {
    app.add_flag_callback(
           option, [&said, option] { said.not_built.push_back(option); }, help)
        ->group(later_group);
}

void addSettings(CLI::App& app, Said& said, const std::string& except = "") {
    app.option_defaults()->group(pixel_group);
    const Settings usual;
    Settings::fields(usual, [&](const Field& field, const auto&) {
        const std::string option(field.option);
        if (option == "camera" || option == except) return;
        const std::string value = valueOf(usual, option);
        app.add_option_function<std::string>(
               "--" + option,
               [&said, option](const std::string& words) { said.settings.emplace_back(option, words); },
               std::string(field.help) + (value.empty() ? "" : " (" + value + ")"))
            ->type_name(acceptedValues(option));
    });
    app.add_option(
           "--camera", said.cameras,
           "index, name, or \"eye=x,y,z target=x,y,z fov=deg near=m far=m\"; may be given several times")
        ->type_name("CAMERA")
        ->allow_extra_args(false);
    app.add_option("--settings", said.settings_file,
                   "any of these as JSON, as every report prints them; applied first")
        ->type_name("FILE.json");
    app.add_option("--frames", said.frames, "frames of an animation (1)")->type_name("N");
    app.add_option("--fps", said.fps, "their rate (30)")->type_name("F");
    addLaterFlag(app, said, "--heat", "light-count heat map");
}

void addPicture(CLI::App& app, Options& options, Said& said) {
    app.option_defaults()->group(picture_group);
    app.add_option("--debug", said.debug, "the channel that the picture shows (lit)")
        ->type_name("NAME|NUMBER");
    app.add_option("--channels", said.channels, "the channels to make, separated by commas (all)")
        ->type_name("NAME|NUMBER,...");
    CLI::Option* exposure =
        app.add_option("--exposure", options.picture.exposure, "factor on the radiance, pictures only")
            ->type_name("F");
    app.add_option("--ev100", options.picture.ev100, "or exposure value at ISO 100")
        ->type_name("F")
        ->excludes(exposure);
    app.add_flag_callback(
        "--no-tonemap", [&options] { options.picture.tonemap = false; }, "clip instead, pictures only");
}

void addOutput(CLI::App& app, Options& options) {
    app.option_defaults()->group(output_group);
    app.add_flag("--json", options.json, "the result as JSON on stdout, and nothing else there");
    CLI::Option* quiet = app.add_flag("-q,--quiet", options.quiet, "print only errors");
    app.add_flag("-v,--verbose", options.verbose, "say on stderr what is being done")->excludes(quiet);
}

void addFiles(CLI::App& app, Options& options, const std::string& usual) {
    app.option_defaults()->group(output_group);
    app.add_option("-o,--out", options.out, usual)->type_name("DIR|FILE");
    app.add_flag("--force", options.force, "replace what diptych did not write, too");
}

// Which pixels count.
void addSelection(CLI::App& app, SelectionOptions& selection, Said& said) {
    app.option_defaults()->group(selection_group);
    app.add_option("--mask", selection.mask, "compare only where this picture is at least half white")
        ->type_name("FILE");
    app.add_option("--ids", selection.ids, "compare only these materials of the reference")
        ->type_name("ID,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--ignore-edges", selection.ignore_edges,
                   "leave out what is within N pixels of another object")
        ->type_name("N")
        ->check(CLI::Range(0, 1000));
    app.add_option("--crop", said.crop, "compare only this rectangle, from the top left")
        ->type_name("X,Y,WxH");
}

void addTolerances(CLI::App& app, Options& options) {
    app.option_defaults()->group(selection_group);
    app.add_option("--tolerances", options.tolerances,
                   "rules of what may differ, see compare/tolerances.schema.json")
        ->type_name("FILE.json");
}

void addDiff(CLI::App& app, PictureDiffOptions& diff, Said& said) {
    app.option_defaults()->group(selection_group);
    app.add_option("--metric", said.metric,
                   "the figure that decides: flip, rmse, max, relative, psnr, ssim, ulp, ... (flip)")
        ->type_name("NAME");
    app.add_option("--tolerance", said.tolerance, "the most that passes; psnr and ssim: the least (identity)")
        ->type_name("T");
    app.add_option("--warn", diff.warn, "what is beyond it is warned of")->type_name("T");
    app.add_option("--failing", diff.failing,
                   "instead of --metric: this share of pixels may have errors above the tolerance")
        ->type_name("SHARE")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--channels", diff.channels, "names of what is compared, * and ? allowed (all)")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--map", diff.names, "what another renderer's channels are called here; repeatable")
        ->type_name("NAME=CHANNEL,...")
        ->allow_extra_args(false);
    app.add_option("--blur", diff.blur, "blur both first, standard deviation in pixels (0)")
        ->type_name("PIXELS")
        ->check(CLI::Range(0.0, 100.0));
    app.add_option("--shift", diff.shift, "forgive what moved by up to so many pixels (0)")
        ->type_name("PIXELS")
        ->check(CLI::Range(0, 16));
    app.add_option("--ppd", diff.flip.pixels_per_degree, "FLIP: pixels per degree of the view (67.0206)")
        ->type_name("F");
    app.add_option("--start-exposure", diff.flip.start_exposure,
                   "HDR-FLIP: the darkest exposure, stops (from the reference)")
        ->type_name("STOPS");
    app.add_option("--stop-exposure", diff.flip.stop_exposure, "HDR-FLIP: the brightest exposure, stops")
        ->type_name("STOPS");
    app.add_option("--exposures", diff.flip.exposures, "HDR-FLIP: how many between them")
        ->type_name("N")
        ->check(CLI::Range(1, 1000));
}

void addDevice(CLI::App& app, Options& options) {
    app.option_defaults()->group(device_group);
    app.add_option("--device", options.device, "index or part of a name, see diptych devices (a GPU first)")
        ->type_name("INDEX|NAME");
    app.add_flag("--validate", options.validate, "with Vulkan validation; any message is a failure");
}

// --heat is a flag, and a flag takes a value behind = only: so that "--heat off" says what it seems to.
std::vector<std::string> joinFlagValues(const std::vector<std::string>& words) {
    std::vector<std::string> joined;
    for (const std::string& word : words)
        if (!joined.empty() && joined.back() == "--heat" && (word == "on" || word == "off" || word == "none"))
            joined.back() += word == "on" ? "=true" : "=false";
        else
            joined.push_back(word == "--heat=none" ? "--heat=false" : word);
    return joined;
}

// Everything that `command` understands.
void describe(CLI::App& app, const std::string& command, Options& options, Said& said) {
    if (command == "devices") {
        addSettings(app, said);
        addPicture(app, options, said);
        addDevice(app, options);
        addFiles(app, options, "refused: devices writes no file, --json prints one");
        return addOutput(app, options);
    }

    if (command == "diff") {
        app.add_option("images", options.scenes, "reference and test image")
            ->type_name("A B")
            ->expected(2)
            ->required();
        addDiff(app, options.diff, said);
        addSelection(app, options.diff.selection, said);
        addTolerances(app, options);
        addFiles(
            app, options,
            "X.exr: errors of every channel; X.png: of the one that decides; else a folder for a report; "
            "without it nothing is written");
        return addOutput(app, options);
    }

    app.add_option("scene", options.scenes, "glTF files, or builtin:NAME (builtin:gallery)")
        ->type_name("SCENE...");
    addSettings(app, said, command == "bench" ? "assign" : "");
    addPicture(app, options, said);
    addDevice(app, options);
    app.add_option("--runs", options.runs, "timed frames; 0 measures no time (5)")->type_name("N");

    if (command == "compare") {
        addFiles(app, options, "folder of the report (diptych-report)");
        app.add_option(
               "--baseline", said.baseline,
               "the left panel: deferred, forward_plus, or an EXR, with which both are compared (deferred)")
            ->type_name("PATH|FILE.exr");
        app.add_flag("--single-file", options.single_file, "embed the pictures in index.html at half size");
        app.add_flag("--update-baseline", options.update_baseline,
                     "write the --baseline FILE.exr anew; the old one stays as FILE.exr.old");
        addSelection(app, options.selection, said);
        addTolerances(app, options);
        app.add_flag("--allow-noise", options.allow_noise,
                     "GPU: grant what two runs of one path differ by on top of a tolerance");
        addLater(app, said, "--pixel", "X,Y", "one pixel's whole story");
    } else if (command == "render") {
        addFiles(app, options,
                 "X.exr: every channel; X.png: the picture; else a folder for both (diptych-render)");
        app.add_flag("--list-scenes", options.list_scenes, "name the built-in scenes and end");
    } else {
        addFiles(app, options,
                 command == "plan" ? "refused: plan writes no file, --json prints one" : "where to write");
    }
    addOutput(app, options);
    if (command == "choose") {
        addLater(app, said, "--max-error", "E", "error budget");
        addLater(app, said, "--max-ms", "T", "time budget, milliseconds");
        addLater(app, said, "--max-bytes", "B", "memory budget");
    } else if (command == "audit") {
        addLater(app, said, "--quantity", "NAME,...", "what to push");
        addLater(app, said, "--require", "NAME=MAGNITUDE", "how far each must go");
    } else if (command == "bench") {
        addLater(app, said, "--paths", "PATH,...", "the paths to time");
        addLater(app, said, "--assign", "ASSIGNMENT,...", "the assignments to time");
    }
}

int channelNumber(const std::string& word, const std::string& option) {
    if (const DebugMode* mode = findDebugMode(word)) return mode->number;
    std::string all;
    for (const DebugMode& mode : debugModes())
        all += fmt::format("{}{} {}", all.empty() ? "" : ", ", mode.number, mode.name);
    throw std::runtime_error(fmt::format("{} {}: no such channel; there are {}", option, word, all));
}

std::vector<int> channelNumbers(const std::string& list) {
    std::vector<int> numbers;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');)
        numbers.push_back(channelNumber(word, "--channels"));
    std::ranges::sort(numbers);
    numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
    return numbers;
}

Settings settingsFromFile(const std::string& file) {
    if (std::filesystem::is_directory(file)) throw std::runtime_error("--settings " + file + ": is a folder");
    std::ifstream stream(file, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    if (!stream.is_open()) throw std::runtime_error("--settings " + file + ": cannot be read");
    try {
        return settingsFromJson(text);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(file + ": " + error.what());
    }
}

Settings settingsOf(const Said& said) {
    Settings settings;
    if (!said.settings_file.empty()) settings = settingsFromFile(said.settings_file);
    for (const auto& [option, value] : said.settings) set(settings, option, value);
    if (!said.cameras.empty()) settings.camera = said.cameras.front();
    return settings;
}

void resolveBaseline(Options& options, const Said& said) {
    if (said.baseline == "reference")
        throw std::runtime_error(
            "--baseline reference is not built yet; use deferred, forward_plus or a file");
    const bool path = said.baseline == "deferred" || said.baseline == "forward_plus";
    if (path) options.baseline = said.baseline == "deferred" ? Path::deferred : Path::forward_plus;
    if (!path && !said.baseline.ends_with(".exr"))
        throw std::runtime_error(fmt::format(
            "--baseline {}: is neither deferred nor forward_plus nor an .exr file", said.baseline));
    if (!path) options.baseline_file = said.baseline;
    if (options.update_baseline && path)
        throw std::runtime_error("--update-baseline: --baseline FILE.exr says which file");
}

void resolveWhatCounts(Options& options, const Said& said) {
    PictureDiffOptions& diff = options.diff;
    if (!said.crop.empty()) options.selection.crop = diff.selection.crop = cropOf(said.crop);
    diff.metric = figureOfMetric(said.metric.empty() ? "flip" : said.metric);
    diff.metric_given = !said.metric.empty();
    if (diff.failing && diff.metric_given)
        throw std::runtime_error("--failing: counts pixels by the channel's own errors; leave out --metric");
    if (!std::isfinite(diff.blur)) throw std::runtime_error("--blur: is no number of pixels");
    const Figure& figure = *findFigure(diff.metric);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double identity = !figure.more_is_better ? 0 : figure.name == "ssim" ? 1 : infinity;
    diff.tolerance = said.tolerance.value_or(identity);
    if (std::isnan(diff.tolerance) || (diff.tolerance < 0 && !figure.more_is_better))
        throw std::runtime_error(fmt::format("--tolerance {}: 0 or more", diff.tolerance));
    if (diff.failing && !said.tolerance)
        throw std::runtime_error("--failing: --tolerance says above which error a pixel fails");
}

// What each word means together with the others.
void resolve(Options& options, const Said& said) {
    options.settings = settingsOf(said);
    options.cameras = said.cameras.empty() ? std::vector{options.settings.camera} : said.cameras;
    options.path_given =
        std::ranges::any_of(said.settings, [](const auto& pair) { return pair.first == "path"; });
    options.debug_given = !said.debug.empty();
    if (options.debug_given) options.shown = channelNumber(said.debug, "--debug");
    if (said.channels != "all") options.channels = channelNumbers(said.channels);
    if (options.scenes.empty()) options.scenes = {"builtin:gallery"};

    if (options.runs < 0) throw std::runtime_error(fmt::format("--runs {}: 0 or more", options.runs));
    if (options.picture.exposure &&
        !(*options.picture.exposure > 0 && std::isfinite(*options.picture.exposure)))
        throw std::runtime_error(fmt::format("--exposure {}: above 0, finite", *options.picture.exposure));
    if (options.picture.ev100 && !std::isfinite(*options.picture.ev100))
        throw std::runtime_error(fmt::format("--ev100 {}: finite", *options.picture.ev100));
    if (!(said.fps > 0) || !std::isfinite(said.fps))
        throw std::runtime_error(fmt::format("--fps {}: above 0", said.fps));
    if (said.frames < 1) throw std::runtime_error(fmt::format("--frames {}: 1 or more", said.frames));

    if (said.frames != 1)
        throw std::runtime_error(fmt::format("--frames {} is not built yet; use 1", said.frames));
    if (!said.not_built.empty()) throw std::runtime_error(said.not_built.front() + " is not built yet");
    resolveBaseline(options, said);
    resolveWhatCounts(options, said);
}

// CLI11 calls an option that was given too often "--size: At Most 1 required but received 3".
std::string inOurWords(const std::string& error) {
    constexpr std::string_view tooOften = ": At Most 1 required but received ";
    const std::size_t at = error.find(tooOften);
    if (at == std::string::npos) return error;
    return fmt::format("{}: given {} times; once is enough", error.substr(0, at),
                       error.substr(at + tooOften.size()));
}

}  // namespace

Options parseCommandLine(const std::vector<std::string>& words) {
    Options options;
    options.scenes.clear();
    Said said;

    CLI::App app(
        "Draws one glTF scene through a deferred and a forward+ path and says where the two differ,\n"
        "by how much, why, and what each costs.",
        "diptych");
    app.set_version_flag("--version", std::string("diptych ") + versionName());
    app.require_subcommand(1);
    app.get_formatter()->column_width(44);
    app.footer(
        "Example: diptych compare builtin:gallery\nEach command has its own --help.\n"
        "Exit codes: 0 parity, 1 a difference beyond tolerance, 2 could not do it.");
    for (const Command& command : commands) {
        CLI::App& sub =
            *app.add_subcommand(command.name, command.does + (command.built ? "" : " (not built yet)"));
        sub.footer("Example: " + command.example);
        describe(sub, command.name, options, said);
    }

    const auto known = [&](const Command& command) { return command.name == words.front(); };
    if (words.empty()) throw std::runtime_error("a command is missing; see diptych --help");
    if (!words.front().starts_with('-') && std::ranges::none_of(commands, known))
        throw std::runtime_error(words.front() + ": no such command; see diptych --help");

    const CLI::App* chosen = &app;
    try {
        const std::vector<std::string> joined = joinFlagValues(words);
        app.parse(
            std::vector<std::string>(joined.rbegin(), joined.rend()));  // CLI11 takes them from the back
        chosen = app.get_subcommands().front();
    } catch (const CLI::CallForHelp&) {
        for (const CLI::App* sub : app.get_subcommands()) chosen = sub;
        options.help = chosen->help(chosen == &app ? "" : "diptych");
        return options;
    } catch (const CLI::CallForVersion& version) {
        options.help = std::string(version.what()) + "\n";
        return options;
    } catch (const CLI::ParseError& error) {
        for (const CLI::App* sub : app.get_subcommands()) chosen = sub;
        throw std::runtime_error(fmt::format("{}; see diptych {}--help", inOurWords(error.what()),
                                             chosen == &app ? "" : chosen->get_name() + " "));
    }

    options.command = chosen->get_name();
    const auto command = std::ranges::find(commands, options.command, &Command::name);
    if (!command->built) throw std::runtime_error(options.command + " is not built yet");
    resolve(options, said);
    return options;
}

}  // namespace diptych
