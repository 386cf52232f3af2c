// SPDX-License-Identifier: MIT
#include "compare/cli/command_view.h"

#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/command_line.h"
#include "compare/files/diptych_files.h"
#include "compare/viewer/interface/keys.h"
#include "compare/viewer/viewer.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image_file.h"
#include "shared/scene/load.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>

namespace diptych::cli {

namespace {

// Accepts every option of compare, so that one option line works for both.
void describeView(CLI::App& app, ViewLine& options) {
    addScene(app, options, one_scene_help);
    addSides(app, options);
    addCompared(app, options, "folder for the files that the key P writes (the current one)");
    addEvaluated(app, options);
    app.option_defaults()->group("View");
    addOption(app, "--report", options.report, "DIR",
              "open a report of compare at the worst pixel of its first failing channel; --debug selects "
              "another channel, SCENE another scene");
    app.add_flag("--watch", options.watch, "reload the scene when its files change on disk");
    app.get_option("--pixel")->description("pixel to inspect first");
    addOutput(app, options);
    acceptUnread(app, {"--runs", "--channels", "--times", "--renderer", "--single-file", "--keep",
                       "--update-baseline", "--explain", "--force", "--json", "--strict", "--allow-empty"});
}

using JsonValue = JsonAt<nlohmann::json>;

// One comparison of a report, and one of its channels.
struct ReportedView {
    std::vector<std::string> command;  // reproduces the comparison
    std::string channel;
    std::optional<Pixel> pixel;
};

constexpr int max_side = 65536;  // largest image side, pixels

bool fails(const JsonValue& of) {
    return of.at("verdict").text() == "fail";
}

bool isOf(const JsonValue& channel, Channel shown) {
    return channel.at("number").json() == channelIndex(shown);
}

// Whether the comparison fails; with --debug, whether that channel fails.
bool failsHere(const JsonValue& comparison, const ViewLine& options) {
    if (!options.debug_requested) return fails(comparison);
    return std::ranges::any_of(comparison.at("channels").each(), [&](const JsonValue& channel) {
        return isOf(channel, options.shown) && fails(channel);
    });
}

// The first failing comparison, else the first. Considers only the given scene, if any.
JsonValue chosenComparison(const JsonValue& comparisons, const ViewLine& options) {
    std::optional<JsonValue> first;
    for (const JsonValue& comparison : comparisons.each()) {
        if (options.scene_requested && comparison.at("scene").text() != options.scenes.front()) continue;
        if (!first) first = comparison;
        if (failsHere(comparison, options)) return comparison;
    }
    if (!first)
        fail(options.scene_requested ? "has no comparison of " + options.scenes.front()
                                     : "has no comparison");
    return *first;
}

// The channel of --debug, else the first that fails, else lit.
JsonValue chosenChannel(const JsonValue& channels, const ViewLine& options) {
    std::optional<JsonValue> best;
    for (const JsonValue& channel : channels.each()) {
        if (options.debug_requested && isOf(channel, options.shown)) return channel;
        if (fails(channel) && (!best || !fails(*best))) best = channel;
        if (!best && isOf(channel, Channel::lit)) best = channel;
    }
    if (options.debug_requested) fail(fmt::format("has no channel {}", debugMode(options.shown).name));
    return best ? *best : channels[0];
}

ReportedView readReport(const ViewLine& options) {
    const std::filesystem::path file = options.report / "report.json";
    return named("--report " + options.report.string(), [&] {
        if (!isDiptychManifest(file))
            fail("is not a report folder written by compare: it has no report.json of Diptych");
        static const std::set<std::string> wanted{"comparisons", "scene", "command", "channels",
                                                  "number",      "name",  "verdict", "worst_pixel"};
        const nlohmann::json report = parseJson(
            textIn(file, json_bytes), [](int, const std::string& key) { return wanted.contains(key); });
        const JsonValue comparison = chosenComparison(JsonValue(report).at("comparisons"), options);
        const JsonValue channel = chosenChannel(comparison.at("channels"), options);
        ReportedView view{
            .command = comparison.at("command").texts(), .channel = channel.at("name").text(), .pixel = {}};
        if (view.command.empty() || view.command.front() != "compare")
            fail("is not a report of compare, which view needs");
        if (!findDebugMode(view.channel)) channel.at("name").fail("is not a channel");
        if (const JsonValue worst = channel.at("worst_pixel"); worst.json().is_array()) {
            const int x = worst[0].whole(-1, max_side), y = worst[1].whole(-1, max_side);
            if (x >= 0 && y >= 0) view.pixel = Pixel{x, y};
        }
        return view;
    });
}

// Options of the report's comparison, extended by those of this command line.
ViewLine reported(const ViewLine& requested) {
    const ReportedView of = readReport(requested);
    ViewLine options =
        named("--report " + requested.report.string(), [&] { return parseReported(of.command); });
    checkAsked("--report " + requested.report.string(), options.scenes.front(), options.settings);
    options.shown = findDebugMode(of.channel)->channel;
    options.pixel = requested.pixel ? requested.pixel : of.pixel;
    options.size_requested = true;
    options.report = requested.report;
    options.watch = requested.watch;
    options.device = requested.device;
    options.validate = requested.validate;
    options.quiet = requested.quiet;
    options.verbose = requested.verbose;
    options.out = requested.out;
    return options;
}

void checkOneWindow(const ViewLine& options) {
    if (options.scenes.size() > 1)
        refuse("view shows one scene, and {} are given; run it once for each", options.scenes.size());
    if (options.cameras.size() > 1)
        refuse("--camera {}: view starts at one camera, and the key N goes to the next", options.cameras[1]);
}

int runView(const ViewLine& requested) {
    checkOneWindow(requested);
    const bool isReport = !requested.report.empty();
    const ViewLine options = isReport ? reported(requested) : requested;
    viewer::ViewerOptions view;
    view.subject.scene = options.scenes.front();
    view.subject.settings = options.settings;
    view.subject.sides = options.sides;
    // Pixel coordinates and images beside the view refer to the size that compare renders.
    view.size_requested =
        options.size_requested || options.pixel || options.selection.any() || !options.baseline_file.empty();
    view.view_options.mode = options.shown;
    if (isReport) view.view_options.difference = viewer::Difference::absolute;
    if (isReference(options.baseline)) view.view_options.against = viewer::Against::reference;
    if (!options.baseline_file.empty()) {
        view.view_options.against = viewer::Against::file;
        view.view_options.file = options.baseline_file;
        if (!std::filesystem::exists(imageName(options.baseline_file).file))
            refuse("--baseline {}: no such file", options.baseline_file.string());
    }
    const ImageChoice image = imageChoice(options);
    view.view_options.exposure = image.exposure;
    view.view_options.ev100 = image.ev100;
    view.view_options.tonemap = image.tonemap;
    if (options.pixel) view.pixel = viewer::PixelPosition{options.pixel->x, options.pixel->y};
    if (view.pixel && (view.pixel->x >= view.subject.settings.size.width ||
                       view.pixel->y >= view.subject.settings.size.height))
        refuse("--pixel {},{}: is outside the image; --size sets its size", view.pixel->x, view.pixel->y);
    for (const Path path : drawn_paths)
        checkSettings(options.sides.of(withoutReference(view.subject.settings), path));
    // Report usage errors before the window opens, and later errors inside it.
    if (std::filesystem::is_directory(view.subject.scene))
        refuse("{}: is a folder; view shows one scene, so give a .gltf or .glb file", view.subject.scene);
    checkScene(view.subject.scene, view.subject.settings.variant);
    logVerbose(options, "on " + Device(deviceOptions(options)).info().name);
    view.watch = options.watch;
    view.out = options.out;
    view.device = deviceOptions(options);
    view.compare = compareOptions(options);
    view.log = [&](const std::string& line) { logVerbose(options, "view: " + line); };
    const viewer::ViewerResult result = viewer::runViewer(view);
    if (result.validation_messages > 0)
        refuse("--validate: {}, the first: {}", counted(result.validation_messages, "message"),
               result.first_validation_message);
    return 0;
}

}  // namespace

ViewLine parseReported(const std::vector<std::string>& words) {
    constexpr std::array taken{"--baseline", "--tolerances",  "--against-device", "--device",
                               "--mask",     "--ids",         "--ignore-edges",   "--crop",
                               "--deferred", "--forward-plus"};
    constexpr std::array flags{"--allow-noise", "--strict", "--allow-empty"};
    constexpr std::array unsupported{"-o", "--renderer"};
    const auto isOneOf = [](const auto& options, const std::string& name) {
        return std::ranges::find(options, name) != options.end();
    };
    const auto isSetting = [](const std::string& name) {
        return std::ranges::any_of(
            settingFields(), [&](const Field& field) { return name == "--" + std::string(field.option); });
    };
    std::vector<std::string> read{"view"};
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        const std::string name = word.substr(0, word.find('='));
        if (word == "--") {  // scenes follow
            read.insert(read.end(), words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
            break;
        }
        if (!word.starts_with('-') || isOneOf(flags, word)) {
            read.push_back(word);
            continue;
        }
        const bool unread = isOneOf(unsupported, name);
        if (!unread && !isOneOf(taken, name) && !isSetting(name))
            refuse(
                "the command of the comparison has {}: view takes only scene, Settings and comparison "
                "options from a report",
                oneLine(name));
        if (name == word && i + 1 == words.size())
            refuse("the command of the comparison ends after {}, without its value", name);
        // Joined with "=", so that CLI11 never reads a value as an option.
        const std::string value = name == word ? name + "=" + words[++i] : word;
        if (!unread) read.push_back(value);
    }
    return dynamic_cast<const ViewLine&>(*parseCommandLine(read).command.line);
}

Command viewCommand() {
    return makeCommand<ViewLine>(
        {"view", "Opens a window with both paths live: wipe, differences, channels, verdict, pixel breakdown",
         "diptych view helmet.glb", "report watch debug baseline gbuffer lights shadows camera size device",
         "\n\nKeys:\n" + viewer::keyColumns()},
        describeView, resolveCompare, runView);
}

}  // namespace diptych::cli
