// SPDX-License-Identifier: MIT
#include "compare/cli/command_line.h"
#include "compare/cli/commands.h"
#include "compare/cli/verdict_words.h"
#include "compare/files/our_files.h"
#include "compare/render/shown_scene.h"
#include "compare/viewer/viewer.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/picture_file.h"
#include "shared/scene/load.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/named.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace diptych::cli {

namespace {

using Place = JsonAt<nlohmann::json>;

// One comparison of a report, and one of its channels.
struct ReportedView {
    std::vector<std::string> command;  // reproduces the comparison
    std::string channel;
    std::optional<Options::Pixel> pixel;
};

constexpr int most_side = 65536;  // largest image side, pixels

bool fails(const Place& of) {
    return of.at("verdict").text() == "fail";
}

bool isOf(const Place& channel, Channel shown) {
    return channel.at("number").json() == channelNumber(shown);
}

// Whether the comparison fails; with --debug, whether that channel fails.
bool failsHere(const Place& comparison, const Options& options) {
    if (!options.debug_given) return fails(comparison);
    return std::ranges::any_of(comparison.at("channels").each(), [&](const Place& channel) {
        return isOf(channel, options.shown) && fails(channel);
    });
}

// The first failing comparison, else the first. Considers only the given scene, if any.
Place chosenComparison(const Place& comparisons, const Options& options) {
    std::optional<Place> first;
    for (const Place& comparison : comparisons.each()) {
        if (options.scene_given && comparison.at("scene").text() != options.scenes.front()) continue;
        if (!first) first = comparison;
        if (failsHere(comparison, options)) return comparison;
    }
    if (!first)
        fail(options.scene_given ? "has no comparison of " + options.scenes.front() : "has no comparison");
    return *first;
}

// The channel of --debug, else the first that fails, else lit.
Place chosenChannel(const Place& channels, const Options& options) {
    std::optional<Place> best;
    for (const Place& channel : channels.each()) {
        if (options.debug_given && isOf(channel, options.shown)) return channel;
        if (fails(channel) && (!best || !fails(*best))) best = channel;
        if (!best && isOf(channel, Channel::lit)) best = channel;
    }
    if (options.debug_given) fail(fmt::format("has no channel {}", debugMode(options.shown).name));
    return best ? *best : channels[0];
}

ReportedView readReport(const Options& options) {
    const std::filesystem::path file = options.view.report / "report.json";
    return named("--report " + options.view.report.string(), [&] {
        if (!isOurManifest(file))
            fail("is not a report folder written by compare: it has no report.json of Diptych");
        static const std::set<std::string> wanted{"comparisons", "scene", "command", "channels",
                                                  "number",      "name",  "verdict", "worst_pixel"};
        const nlohmann::json report = parseJson(
            textIn(file, json_bytes), [](int, const std::string& key) { return wanted.contains(key); });
        const Place comparison = chosenComparison(Place(report).at("comparisons"), options);
        const Place channel = chosenChannel(comparison.at("channels"), options);
        ReportedView view{
            .command = comparison.at("command").texts(), .channel = channel.at("name").text(), .pixel = {}};
        if (view.command.empty() || view.command.front() != "compare")
            fail("is not a report of compare, which view needs");
        if (!findDebugMode(view.channel)) channel.at("name").fail("is not a channel");
        if (const Place worst = channel.at("worst_pixel"); worst.json().is_array()) {
            const int x = worst[0].whole(-1, most_side), y = worst[1].whole(-1, most_side);
            if (x >= 0 && y >= 0) view.pixel = Options::Pixel{x, y};
        }
        return view;
    });
}

// Options of the report's comparison, extended by those of this command line.
Options reported(const Options& given) {
    const ReportedView of = readReport(given);
    Options options =
        named("--report " + given.view.report.string(), [&] { return parseReported(of.command); });
    checkAsked("--report " + given.view.report.string(), options.scenes.front(), options.settings);
    options.shown = findDebugMode(of.channel)->channel;
    options.pixel = given.pixel ? given.pixel : of.pixel;
    options.size_given = true;
    options.view = given.view;
    options.device = given.device;
    options.validate = given.validate;
    options.quiet = given.quiet;
    options.verbose = given.verbose;
    options.out = given.out;
    return options;
}

void checkOneWindow(const Options& options) {
    if (options.scenes.size() > 1)
        throw std::runtime_error(fmt::format("view shows one scene, and {} are given; run it once for each",
                                             options.scenes.size()));
    if (options.cameras.size() > 1)
        throw std::runtime_error(fmt::format(
            "--camera {}: view starts at one camera, and the key N goes to the next", options.cameras[1]));
}

}  // namespace

int runView(const Options& given) {
    checkOneWindow(given);
    const bool isReport = !given.view.report.empty();
    const Options options = isReport ? reported(given) : given;
    viewer::ViewerOptions view;
    view.subject.scene = options.scenes.front();
    view.subject.settings = options.settings;
    view.subject.sides = options.sides;
    // Pixel coordinates and images beside the view refer to the size that compare renders.
    view.size_given =
        options.size_given || options.pixel || options.selection.any() || !options.baseline_file.empty();
    view.look.mode = options.shown;
    if (isReport) view.look.difference = viewer::Difference::absolute;
    if (isReference(options.baseline)) view.look.against = viewer::Against::reference;
    if (!options.baseline_file.empty()) {
        view.look.against = viewer::Against::file;
        view.look.file = options.baseline_file;
        if (!std::filesystem::exists(pictureName(options.baseline_file).file))
            throw std::runtime_error(
                fmt::format("--baseline {}: no such file", options.baseline_file.string()));
    }
    const PictureChoice picture = pictureChoice(options);
    view.look.exposure = picture.exposure;
    view.look.ev100 = picture.ev100;
    view.look.tonemap = picture.tonemap;
    if (options.pixel) view.pixel = viewer::PixelPlace{options.pixel->x, options.pixel->y};
    if (view.pixel && (view.pixel->x >= view.subject.settings.size.width ||
                       view.pixel->y >= view.subject.settings.size.height))
        throw std::runtime_error(fmt::format("--pixel {},{}: is outside the image; --size sets its size",
                                             view.pixel->x, view.pixel->y));
    for (const Path path : drawn_paths) {
        const Settings settings = options.sides.of(withoutReference(view.subject.settings), path);
        if (const auto problem = settings.problem()) throw std::runtime_error(*problem);
    }
    // Report usage errors before the window opens, and later errors inside it.
    if (std::filesystem::is_directory(view.subject.scene))
        throw std::runtime_error(fmt::format(
            "{}: is a folder; view shows one scene, so give a .gltf or .glb file", view.subject.scene));
    checkScene(view.subject.scene, view.subject.settings.variant);
    say(options, "on " + Device(deviceOptions(options)).info().name);
    view.watch = options.view.watch;
    view.out = options.out;
    view.device = deviceOptions(options);
    view.compare = compareOptions(options);
    view.say = [&](const std::string& line) { say(options, "view: " + line); };
    const viewer::ViewerResult result = viewer::runViewer(view);
    if (result.validation_messages > 0)
        throw std::runtime_error(fmt::format("--validate: {}, the first: {}",
                                             counted(result.validation_messages, "message"),
                                             result.first_validation_message));
    return 0;
}

}  // namespace diptych::cli
