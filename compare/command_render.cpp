// SPDX-License-Identifier: MIT
#include "compare/commands.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/atomic_file.h"
#include "shared/scene/builtin/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace diptych {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* single_mark = "frame.json";    // in a folder that holds one Frame
constexpr const char* several_mark = "frames.json";  // in a folder that holds a folder for each Frame

std::filesystem::path numbered(const std::filesystem::path& folder, std::size_t frame) {
    return folder / std::to_string(frame + 1);
}

// One Frame may replace several and the other way round. Whatever cannot be replaced is said before the
// first Frame is drawn.
void checkFolder(const Output& output, std::size_t count, bool force) {
    const bool single = output.kind != OutputKind::folder || isOurMark(output.path / single_mark);
    checkReplaceable(output, single ? single_mark : several_mark, force);
    for (std::size_t i = 0; count > 1 && i < count; ++i)
        checkReplaceable({OutputKind::folder, numbered(output.path, i)}, single_mark, force);
}

// What an earlier render left that `count` Frames do not replace.
void removeStale(const std::filesystem::path& folder, std::size_t count, bool severalBefore) {
    if (count > 1) removeListed(folder, single_mark);
    for (std::size_t i = count > 1 ? count : 0; severalBefore && isOurMark(numbered(folder, i) / single_mark);
         ++i)
        removeListed(numbered(folder, i), single_mark);
    if (count == 1) removeListed(folder, several_mark);
}

int listScenes(const Options& options) {
    Json names = Json::array();
    for (const BuiltinName& scene : builtinNames()) {
        const std::string name =
            "builtin:" + scene.name + (scene.parameter.empty() ? "" : "?" + scene.parameter);
        names.push_back({{"name", name}, {"shows", scene.shows}, {"for_tests", scene.for_tests}});
        if (!options.json && !options.quiet) fmt::print("{:<30} {}\n", name, scene.shows);
    }
    if (options.json) fmt::print("{}\n", Json{{"schema", 1}, {"scenes", names}}.dump(2));
    return 0;
}

// Asked for by name, it must be there; of "all", a path gives what it can.
void checkChannels(const Options& options) {
    if (options.settings.path != Path::deferred) return;
    const auto check = [](const DebugMode& mode, const char* option) {
        if (mode.maker == MadeBy::forward_only)
            throw std::runtime_error(fmt::format(
                "{} {}: the deferred path's G-buffer does not carry it; --path forward_plus makes it", option,
                mode.name));
    };
    for (const int channel : options.channels) check(debugMode(channel), "--channels");
    check(debugMode(options.shown), "--debug");
}

// What the files need: an EXR the channels asked for; a picture the one that it shows, lit for its exposure,
// and which pixels are background.
std::vector<int> channelsFor(OutputKind kind, const Options& options, std::vector<int> asked) {
    constexpr auto lit = static_cast<int>(gpu::DEBUG_lit),
                   background = static_cast<int>(gpu::DEBUG_material_id);
    if (kind == OutputKind::exr) return asked;
    if (kind == OutputKind::png) return {lit, options.shown, background};
    for (const int needed : {lit, options.shown, background})
        if (std::ranges::count(asked, needed) == 0) asked.push_back(needed);
    return asked;
}

std::string jsonText(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

int runRender(const Options& options) {
    if (options.list_scenes) return listScenes(options);
    const std::vector<Settings> settings = plan(options, {options.settings.path});
    checkChannels(options);
    const Output output = outputOf(options.out.empty() ? "diptych-render" : options.out);
    const bool several = settings.size() * options.scenes.size() > 1;
    if (several && output.kind != OutputKind::folder)
        throw std::runtime_error(fmt::format(
            "-o {}: holds one Frame, and several were asked for; give a folder", output.path.string()));
    checkFolder(output, settings.size() * options.scenes.size(), options.force);
    const bool severalBefore = isOurMark(output.path / several_mark);
    RenderOptions render = renderOptions(options);
    render.channels = channelsFor(output.kind, options, render.channels);

    Device device(deviceOptions(options));
    say(options, "on " + device.info().name);
    const ReportDevice made = reportDevice(device);
    Json result{{"schema", 1},
                {"software", softwareName},
                {"device", {{"name", made.name}, {"driver", made.driver}, {"type", made.type}}},
                {"frames", Json::array()}};
    // Everything is drawn before anything is written: a scene that cannot be read leaves no half of a folder.
    std::vector<Frame> frames;
    for (const std::string& name : options.scenes) {
        say(options, name);
        for (Frame& frame : renderAll(device, loadShown(options, name), settings, render))
            frames.push_back(std::move(frame));
        checkValidation(device);
    }
    for (const Frame& frame : frames) {
        Output target = output;
        if (several) target.path = numbered(output.path, result["frames"].size());
        // checkFolder() has seen that it may be replaced.
        writeFrame(frame, made, target, debugMode(options.shown), options.picture, true);
        Json json = jsonOf(frame);
        json["file"] = target.path.string();
        result["frames"].push_back(std::move(json));
        if (options.json || options.quiet) continue;
        fmt::print("{}: {}, {}x{}{}\n", target.path.string(), frame.scene, settings[0].size.width,
                   settings[0].size.height,
                   frame.time.runs > 0 ? fmt::format(", {:.2f} ms", frame.time.median) : "");
        for (const std::string& line : frame.notes) fmt::print("  note: {}\n", line);
    }
    if (several) writeFile(output.path / several_mark, jsonText(result));
    if (output.kind == OutputKind::folder) removeStale(output.path, frames.size(), severalBefore);
    if (options.json) fmt::print("{}", jsonText(result));
    return 0;
}

}  // namespace diptych
