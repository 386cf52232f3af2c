// SPDX-License-Identifier: MIT
#include "compare/cli/scene_group.h"

#include "compare/cli/add_option.h"
#include "compare/report/exposure_line.h"
#include "compare/run/print.h"
#include "shared/text/did_you_mean.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"
#include "shared/text/named.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace diptych::cli {

namespace {

Channel channelNamed(const std::string& word, const std::string& option) {
    if (const DebugMode* mode = findDebugMode(word)) return mode->channel;
    std::string all;
    std::vector<std::string> names;
    for (const DebugMode& mode : debugModes()) {
        names.emplace_back(mode.name);
        all += fmt::format("{}{} {}", all.empty() ? "" : ", ", channelIndex(mode.channel), mode.name);
    }
    refuse("{} {}: no such channel{}; there are {}", option, word, didYouMean(word, names), all);
}

std::vector<Channel> channelsNamed(const std::string& list) {
    std::vector<Channel> channels;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');)
        channels.push_back(channelNamed(word, "--channels"));
    std::ranges::sort(channels);
    channels.erase(std::ranges::unique(channels).begin(), channels.end());
    return channels;
}

// One time of a --times list, s.
double timeOf(const std::string& word, const std::string& list) {
    Settings settings;
    try {
        settings.set("time", word);
    } catch (const std::runtime_error&) {
        refuse("--times {}: \"{}\" is not a time; give seconds, separated by commas", list, word);
    }
    if (settings.problem()) refuse("--times {}: each time must be finite and at least 0 s", list);
    return settings.time;
}

void resolveSettings(SettingsGroup& options) {
    const auto& words = options.settings_text;
    Settings& settings = options.settings;
    if (!words.file.empty()) {
        const std::string text =
            named("--settings " + words.file, [&] { return textIn(words.file, json_bytes); });
        settings = named(words.file, [&] { return settingsFromJson(text); });
        options.size_requested = options.shadows_requested = true;
    }
    for (const auto& [option, value] : words.settings) {
        settings.set(option, value);
        options.path_requested |= option == "path";
        options.size_requested |= option == "size";
        options.shadows_requested |= option == "shadows";
    }
    if (!words.cameras.empty()) settings.camera = words.cameras.front();
    options.sides = readSides(words.sides, settings);
    options.cameras = words.cameras.empty() ? std::vector{settings.camera} : words.cameras;
    options.camera_requested = !settings.camera.empty();
}

void resolveTimes(SettingsGroup& options) {
    const auto& words = options.settings_text;
    options.times = {options.settings.time};
    if (words.times) {
        const std::string& list = *words.times;
        options.times.clear();
        // <= size: a trailing comma yields an empty word, which is an error.
        for (std::size_t at = 0; at <= list.size();) {
            const std::size_t end = std::min(list.find(',', at), list.size());
            const std::string word = list.substr(at, end - at);
            const double time = timeOf(word, list);
            if (std::ranges::find(options.times, time) != options.times.end())
                refuse("--times {}: {} is given twice", list, word);
            options.times.push_back(time);
            at = end + 1;
        }
        options.settings.time = options.times.front();
    }
    options.frames = words.frames.value_or(options.frames);
    options.fps = words.fps.value_or(options.fps);
    if (!(options.fps > 0) || !std::isfinite(options.fps))
        refuse("--fps {}: must be above 0 and finite", options.fps);
    if (options.frames < 1) refuse("--frames {}: must be 1 or more", options.frames);
    if (options.frames > 1 && !options.frames_refused.empty())
        refuse("--frames {}: {}", options.frames, options.frames_refused);
    if (words.fps && !words.frames) refuse("--fps {}: needs --frames N", options.fps);
    if (!std::isfinite(timeOfFrame(options, options.frames - 1)))
        refuse("--fps {}: the time of the last of {} frames is not finite; use a higher --fps", options.fps,
               options.frames);
}

void resolveChannels(ImageGroup& options) {
    const auto& words = options.image_text;
    options.debug_requested = !words.debug.empty();
    if (options.debug_requested) options.shown = channelNamed(words.debug, "--debug");
    if (options.heat) options.shown = Channel::light_count;
    if (words.channels != "all") options.channels = channelsNamed(words.channels);
}

void checkExposure(const ImageChoice& image) {
    if (image.exposure && !(*image.exposure > 0 && std::isfinite(*image.exposure)))
        refuse("--exposure {}: must be above 0 and finite", *image.exposure);
    if (image.ev100 && !std::isfinite(*image.ev100)) refuse("--ev100 {}: must be finite", *image.ev100);
}

}  // namespace

void addSettings(CLI::App& app, SettingsGroup& options, const std::string& except) {
    app.option_defaults()->group(pixel_group);
    auto& parsed = options.settings_text;
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
    addEach(app, "--camera", parsed.cameras, "CAMERA",
            std::string(settingField("camera").help) +
                "; repeatable. A scene without a camera is seen from direction (+1, +0.6, +1), or from "
                "another side or from inside if that shows clearly more");
    app.add_option_function<std::string>(
           "--sort", [&parsed](const std::string& words) { parsed.settings.emplace_back("sort", words); },
           "old name: on means --transparency sorted, off means unsorted")
        ->type_name("on|off");
    addOption(app, "--settings", parsed.file, "FILE.json",
              "Settings as JSON, as every report prints them; applied before other options");
    addOption(app, "--frames", parsed.frames, "N",
              "number of pictures, numbered from 0000; the first is at --time (1)");
    addOption(app, "--fps", parsed.fps, "F", "pictures per second of --frames (30)");
    if (!options.frames_refused.empty()) acceptUnread(app, {"--frames", "--fps"});
}

void addSides(CLI::App& app, SettingsGroup& options) {
    for (std::size_t side = 0; side < drawn_paths.size(); ++side)
        addOption(app, sideOption(drawn_paths.at(side)), options.settings_text.sides.at(side),
                  "NAME=VALUE,...",
                  fmt::format("Settings of {} only, for example assign=every,shadows=off",
                              nameOf(drawn_paths.at(side))))
            ->allow_extra_args(false)
            ->group(pixel_group);
}

void addImage(CLI::App& app, ImageGroup& options) {
    app.option_defaults()->group(image_group);
    addOption(app, "--debug", options.image_text.debug, "NAME|NUMBER",
              "channel that the picture shows (lit)");
    app.add_flag(
        "--heat", options.heat,
        "the picture shows the number of lights each pixel evaluates, with a legend; overrides --debug");
    addOption(app, "--channels", options.image_text.channels, "NAME|NUMBER,...",
              "channels to render, separated by commas (all); render: one PNG each");
    app.add_flag("--list-channels", options.list_channels, "list all channels and exit");
    CLI::Option* exposure =
        addOption(app, "--exposure", options.image.exposure, "F", "factor on the radiance, pictures only");
    CLI::Option* ev100 =
        addOption(app, "--ev100", options.image.ev100, "F", "exposure value at ISO 100, pictures only")
            ->excludes(exposure);
    addOption(app, "--match-exposure", options.match_exposure, "FILE",
              "use the automatic exposure of this EXR or HDR file")
        ->excludes(exposure)
        ->excludes(ev100);
    app.add_flag_callback(
        "--no-tonemap", [&options] { options.image.tonemap = false; },
        "clip instead of tone mapping, pictures only");
}

void addDevice(CLI::App& app, DeviceGroup& options) {
    app.option_defaults()->group(device_group);
    addOption(app, "--device", options.device, "INDEX|NAME",
              "index or part of a name, see diptych devices (a GPU if there is one)");
    app.add_flag("--validate", options.validate,
                 "run under the Vulkan validation layers; any message is a failure");
}

void addAgainst(CLI::App& app, DeviceGroup& options, const char* does) {
    addOption(app, "--against-device", options.against_device, "INDEX|NAME", does)->group(device_group);
}

void addCompileOn(CLI::App& app, std::string& device, const char* does, const char* group) {
    addOption(app, "--compile-on", device, "DEVICE",
              fmt::format("{}: index or part of a name, or an AMD GPU family (vega10, navi21, navi31, "
                          "gfx1201, ...), for which RADV of Mesa 25 compiles without the GPU",
                          does))
        ->group(group);
}

void addScene(CLI::App& app, SceneGroup& options, const char* scenes_help, const std::string& except) {
    addOption(app, "scenes", options.scenes, "SCENE...", scenes_help);
    addSettings(app, options, except);
    addImage(app, options);
    addDevice(app, options);
    addOption(app, "--runs", options.runs_requested, "N",
              fmt::format("timed frames; 0 measures no time ({})", options.runs));
}

void resolveScene(SceneGroup& options) {
    resolveSettings(options);
    resolveChannels(options);
    options.scene_requested = !options.scenes.empty();
    refuseLineBreaks(options.scenes);
    if (options.scenes.empty()) options.scenes = {"builtin:gallery"};
    options.runs = options.runs_requested.value_or(options.runs);
    if (options.runs < 0) refuse("--runs {}: must be 0 or more", options.runs);
    checkExposure(options.image);
    resolveTimes(options);
}

void refuseAgainst(const DeviceGroup& options, const std::string& why) {
    refuse("--against-device {}: {}", options.against_device, why);
}

void checkOneSample(const DeviceGroup& options, const std::vector<Settings>& settings) {
    for (const Settings& of : settings)
        if (!options.against_device.empty() && of.msaa > 1)
            refuseAgainst(options, fmt::format("--msaa {}: lit averages several samples, but the surface "
                                               "channels hold only the first; use --msaa 1",
                                               of.msaa));
}

void checkSettings(const Settings& settings) {
    if (const auto problem = settings.problem()) throw std::runtime_error(*problem);
}

void checkMeasured(const Settings& settings) {
    if (isReference(settings.path))
        refuse("--path reference: errors are measured against it; use deferred or forward_plus");
    if (const auto problem = settings.valueProblem()) throw std::runtime_error(*problem);
    checkSettings(referenceSettings(settings));
}

std::vector<Settings> settingsOf(const SettingsGroup& options, const std::vector<Path>& paths) {
    std::vector<Settings> all;
    for (const std::string& camera : options.cameras)
        for (const double time : options.times)
            for (const Path path : paths) {
                Settings settings = options.settings;
                settings.camera = camera;
                settings.time = time;
                settings = options.sides.of(settings, path);
                // Drop Settings that only the reference reads from the paths beside it.
                if (!isReference(path) && std::ranges::count(paths, Path::reference) > 0)
                    settings = withoutReference(settings);
                checkSettings(settings);
                all.push_back(isReference(path) ? referenceSettings(settings) : settings);
            }
    return all;
}

ImageChoice imageChoice(const ImageGroup& options) {
    ImageChoice choice = options.image;
    if (!options.match_exposure.empty()) choice.exposure = exposureOfFile(options.match_exposure);
    return choice;
}

int listChannels(bool json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const DebugMode& mode : debugModes()) {
        list.push_back({{"number", channelIndex(mode.channel)},
                        {"name", mode.name},
                        {"metric", nameOf(mode.error_kind)},
                        {"shows", mode.shows}});
        if (!json)
            printOut("{:>3}  {:<20} {:<9} {}\n", channelIndex(mode.channel), mode.name,
                     nameOf(mode.error_kind), mode.shows);
    }
    if (json) printOut("{}\n", jsonText(list));
    return 0;
}

RenderOptions renderOptions(const SceneGroup& options) {
    RenderOptions render;
    render.channels = options.channels;
    render.named = !options.channels.empty();
    if (render.channels.empty())
        for (const DebugMode& mode : debugModes()) render.channels.push_back(mode.channel);
    render.requested = render.channels;
    render.runs = options.runs;
    render.on_step = [&options](const std::string& step) { logVerbose(options, step); };
    return render;
}

DeviceOptions deviceOptions(const DeviceGroup& options) {
    return {options.device, options.validate};
}

std::unique_ptr<Device> againstDevice(const DeviceGroup& options) {
    if (options.against_device.empty()) return nullptr;
    return std::make_unique<Device>(DeviceOptions{options.against_device, options.validate});
}

void noteLeftByOthers(const OutputGroup& options, const ReferenceCheckpoints& checkpoints) {
    if (const std::string line = checkpoints.leftByOthers(); !line.empty()) note(options, line);
}

}  // namespace diptych::cli
