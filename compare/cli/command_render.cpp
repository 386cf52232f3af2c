// SPDX-License-Identifier: MIT
#include "compare/cli/command_render.h"

#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/files/output_folder.h"
#include "compare/frames/nonfinite.h"
#include "compare/report/exposure_line.h"
#include "compare/run/print.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/supported_channels.h"
#include "shared/image/atomic_file.h"
#include "shared/scene/builtin/builtin.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace diptych::cli {
namespace {

using Json = nlohmann::ordered_json;

void describeRender(CLI::App& app, RenderLine& options) {
    options.frames_refused.clear();
    addScene(app, options, one_scene_help);
    addFiles(app, options,
             "X.exr: every channel; X.png: the picture; any other name: a folder with both (diptych-render)");
    app.add_flag("--list-scenes", options.list_scenes, "list the built-in scenes and exit");
    addOutput(app, options);
}

int listScenes(const RenderLine& options) {
    Json names = Json::array();
    for (const BuiltinName& scene : builtinNames()) {
        const std::string name =
            "builtin:" + scene.name + (scene.parameter.empty() ? "" : "?" + scene.parameter);
        names.push_back({{"name", name}, {"shows", scene.shows}, {"for_tests", scene.for_tests}});
        if (!options.json && !options.quiet) printOut("{:<30} {}\n", name, scene.shows);
    }
    if (options.json) printOut("{}\n", jsonText(Json{{"schema", 1}, {"scenes", names}}));
    return 0;
}

std::vector<Frame> drawAll(const RenderLine& options, const std::vector<Settings>& settings, Device* device,
                           ReferenceCheckpoints& checkpoints, Progress& progress) {
    const Output output = outputIn(options);
    RenderOptions render = renderOptions(options);
    render.keep = checkpoints.opener();
    render.channels = channelsFor(output.kind, options, render.channels);
    std::vector<Frame> frames;
    const double drawn = drawnFraction(render);
    const auto scenes = static_cast<double>(options.scenes.size());
    for (std::size_t i = 0; i < options.scenes.size(); ++i) {
        const std::string& name = options.scenes[i];
        logVerbose(options, name);
        const auto done = static_cast<double>(i);
        const Stage stage = Stage(progress, name).part(drawn * done / scenes, drawn * (done + 1) / scenes);
        const double loading = loadingFraction(name, render, settings.size());
        const Scene scene = loadSceneWithSettings(name, options.settings, stage.part(0, loading));
        render.progress = stage.part(loading, 1);
        std::ranges::move(
            device ? renderAll(*device, scene, settings, render) : drawWithoutDevice(scene, settings, render),
            std::back_inserter(frames));
        if (device) checkValidation(*device);
    }
    return frames;
}

// Writes the output atomically. Returns the location of each Frame.
std::vector<std::filesystem::path> writeAll(const RenderLine& options, const ImageChoice& image,
                                            const std::vector<Frame>& frames, Json& result,
                                            const ReportDevice& device, const Stage& progress) {
    const Output output = outputIn(options);
    const ChannelSelection selected = selectedChannels(options);
    if (output.kind != OutputKind::folder) {
        progress.at(0, "write");
        writeFrame(frames.front(), device, output, selected, image);
        if (output.kind != OutputKind::png) return {output.path};
        const std::vector<std::filesystem::path> files = imageFiles(output.path, selected);
        for (const std::filesystem::path& file : files) result["frames"][0]["files"].push_back(file.string());
        return {files.size() == 1 ? output.path : output.path.parent_path() / imageNames(files)};
    }
    const auto earlier = [&] { return earlierIn(output, frames.size(), options.force); };
    OutputFolder folder(output.path);
    std::vector<std::string> files;
    std::vector<std::filesystem::path> targets;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        progress.at(static_cast<double>(i) / static_cast<double>(frames.size()), "write");
        const std::string inner = frames.size() > 1 ? std::to_string(i + 1) : "";
        if (!inner.empty()) folder.makeFolders({inner + "/lit.exr"});
        for (const std::string& name : writeFrameFolder(frames[i], device, folder / inner, selected, image))
            files.push_back(inner.empty() ? name : inner + "/" + name);
        targets.push_back(inner.empty() ? output.path : output.path / inner);
        result["frames"][i]["file"] = targets.back().string();
    }
    if (frames.size() > 1) {
        writeFile(folder / frames_manifest, jsonText(result) + "\n");
        files.emplace_back(frames_manifest);
    }
    folder.put(files, earlier);
    return targets;
}

int runRender(const RenderLine& options) {
    if (options.list_scenes) return listScenes(options);
    if (options.frames > 1) return runFrames(options);
    const std::vector<Settings> settings = settingsOf(options, {options.settings.path});
    checkChannels(options);
    noteIgnored(options);
    const ImageChoice image = imageChoice(options);
    const Output output = outputIn(options);
    const std::size_t count = settings.size() * options.scenes.size();
    if (count > 1 && output.kind != OutputKind::folder)
        refuse("-o {}: a file holds one Frame, but several are rendered; give a folder",
               output.path.string());
    if (output.kind == OutputKind::png)
        for (const std::filesystem::path& file : imageFiles(output.path, selectedChannels(options)))
            checkReplaceable({OutputKind::png, file}, single_manifest, options.force);
    else
        checkFolder(output, count, options.force);

    Progress progress(progressOutput(options));
    std::optional<Device> device;
    if (std::ranges::any_of(settings, needsDevice)) device.emplace(deviceOptions(options));
    const ReportDevice made = reportDeviceOf(device);
    logVerbose(options, "on " + made.name);
    Json result = resultOf(made);
    // Render everything before writing, so that an unreadable scene leaves no partial folder.
    ReferenceCheckpoints checkpoints(output.path, output.kind == OutputKind::folder);
    const std::vector<Frame> frames =
        drawAll(options, settings, device ? &*device : nullptr, checkpoints, progress);
    for (const Frame& frame : frames) {
        result["frames"].push_back(jsonOf(frame));
        result["frames"].back()["file"] = output.path.string();
    }
    const std::vector<std::filesystem::path> targets =
        writeAll(options, image, frames, result, made,
                 Stage(progress, output.path.string()).part(drawnFraction(renderOptions(options)), 1));
    checkpoints.remove();
    progress.wipe();
    noteLeftByOthers(options, checkpoints);
    for (std::size_t i = 0; i < frames.size() && !options.json && !options.quiet; ++i) {
        const Frame& frame = frames[i];
        printOut("{}: {}, {}x{}{}\n", targets[i].string(), frame.scene, frame.settings.size.width,
                 frame.settings.size.height,
                 frame.time.runs > 0 ? fmt::format(", {:.2f} ms", frame.time.median) : "");
        if (output.kind != OutputKind::exr) printOut("  picture: {}\n", exposureLine(frame, image));
        for (const std::string& line : frame.notes) printOut("  note: {}\n", line);
        for (const std::string& line : nonfiniteText(frame)) printOut("  note: {}\n", line);
    }
    if (options.json) printOut("{}\n", jsonText(result));
    return 0;
}

}  // namespace

Output outputIn(const OutputGroup& options) {
    return outputOf(options.out.empty() ? "diptych-render" : options.out);
}

std::filesystem::path numbered(const std::filesystem::path& folder, std::size_t frame) {
    return folder / std::to_string(frame + 1);
}

void checkFolder(const Output& output, std::size_t count, bool force) {
    const bool single = output.kind != OutputKind::folder || isDiptychManifest(output.path / single_manifest);
    checkReplaceable(output, single ? single_manifest : frames_manifest, force);
    for (std::size_t i = 0; count > 1 && i < count; ++i)
        checkReplaceable({OutputKind::folder, numbered(output.path, i)}, single_manifest, force);
}

std::vector<std::string> earlierIn(const Output& output, std::size_t count, bool force) {
    checkFolder(output, count, force);
    const std::filesystem::path& folder = output.path;
    std::vector<std::string> names = manifestFiles(folder, single_manifest);
    if (!isDiptychManifest(folder / frames_manifest)) return names;
    std::ranges::move(manifestFiles(folder, frames_manifest), std::back_inserter(names));
    for (std::size_t i = 0; isDiptychManifest(numbered(folder, i) / single_manifest); ++i)
        for (const std::string& name : manifestFiles(numbered(folder, i), single_manifest))
            names.push_back(fmt::format("{}/{}", i + 1, name));
    return names;
}

void checkChannels(const RenderLine& options) {
    const auto check = [&](const DebugMode& mode, const char* option) {
        if (const std::string_view why = unsupportedReason(options.settings, mode); !why.empty())
            refuse("{} {}: {}", option, mode.name, why);
    };
    for (const Channel channel : options.channels) check(debugMode(channel), "--channels");
    check(debugMode(options.shown), options.heat ? "--heat:" : "--debug");
}

ChannelSelection selectedChannels(const RenderLine& options) {
    ChannelSelection selected;
    for (const Channel channel : options.channels) selected.push_back(&debugMode(channel));
    if ((selected.empty() || options.debug_requested || options.heat) &&
        std::ranges::count(options.channels, options.shown) == 0)
        selected.push_back(&debugMode(options.shown));
    return selected;
}

std::vector<Channel> channelsFor(OutputKind kind, const RenderLine& options, std::vector<Channel> requested) {
    if (kind == OutputKind::exr) return requested;
    if (kind == OutputKind::png) requested.clear();
    for (const DebugMode* mode : selectedChannels(options))
        if (std::ranges::count(requested, mode->channel) == 0) requested.push_back(mode->channel);
    for (const Channel needed : {Channel::lit, Channel::material_id})
        if (std::ranges::count(requested, needed) == 0) requested.push_back(needed);
    return requested;
}

void noteIgnored(const RenderLine& options) {
    const Settings &requested = options.settings, defaults;
    for (const Field& field : settingFields()) {
        const std::string_view why = ignoredBecause(requested, field.option);
        if (!why.empty() && requested.valueOf(field.option) != defaults.valueOf(field.option))
            note(options, fmt::format("--{} is not used: {}", field.option, why));
    }
}

nlohmann::ordered_json resultOf(const ReportDevice& made) {
    return {{"schema", 1},
            {"software", softwareName},
            {"device", jsonOf(made)},
            {"frames", nlohmann::ordered_json::array()}};
}

ReportDevice reportDeviceOf(const std::optional<Device>& device) {
    // Named in the files of a reference that needed no device.
    return device ? reportDevice(*device)
                  : ReportDevice{"double precision, no Vulkan device", softwareName, "cpu"};
}

double drawnFraction(const RenderOptions& render) {
    return framesIn(render) / (framesIn(render) + 5);
}

std::string imageNames(const std::vector<std::filesystem::path>& files) {
    std::string names;
    for (const std::filesystem::path& file : files)
        names += (names.empty() ? "" : ", ") + file.filename().string();
    return names;
}

Command renderCommand() {
    return makeCommand<RenderLine>(
        {"render", "Renders one Frame: an EXR with every channel, and a PNG",
         "diptych render helmet.glb --path deferred --debug normals -o normals.png",
         "path debug channels lights shadows camera size time exposure out"},
        describeRender, resolveScene, runRender);
}

}  // namespace diptych::cli
