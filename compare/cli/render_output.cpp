// SPDX-License-Identifier: MIT
#include "compare/cli/render_output.h"

#include "compare/files/our_files.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/made_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace diptych::cli {

Output outputIn(const Options& options) {
    return outputOf(options.out.empty() ? "diptych-render" : options.out);
}

std::filesystem::path numbered(const std::filesystem::path& folder, std::size_t frame) {
    return folder / std::to_string(frame + 1);
}

void checkFolder(const Output& output, std::size_t count, bool force) {
    const bool single = output.kind != OutputKind::folder || isOurManifest(output.path / single_manifest);
    checkReplaceable(output, single ? single_manifest : several_manifest, force);
    for (std::size_t i = 0; count > 1 && i < count; ++i)
        checkReplaceable({OutputKind::folder, numbered(output.path, i)}, single_manifest, force);
}

std::vector<std::string> earlierIn(const std::filesystem::path& folder) {
    std::vector<std::string> names = manifestFiles(folder, single_manifest);
    if (!isOurManifest(folder / several_manifest)) return names;
    std::ranges::move(manifestFiles(folder, several_manifest), std::back_inserter(names));
    for (std::size_t i = 0; isOurManifest(numbered(folder, i) / single_manifest); ++i)
        for (const std::string& name : manifestFiles(numbered(folder, i), single_manifest))
            names.push_back(fmt::format("{}/{}", i + 1, name));
    return names;
}

void checkChannels(const Options& options) {
    const auto check = [&](const DebugMode& mode, const char* option) {
        if (const std::string_view why = notMadeBecause(options.settings, mode); !why.empty())
            throw std::runtime_error(fmt::format("{} {}: {}", option, mode.name, why));
    };
    for (const Channel channel : options.channels) check(debugMode(channel), "--channels");
    check(debugMode(options.shown), options.heat ? "--heat:" : "--debug");
}

ShownChannels shownChannels(const Options& options) {
    ShownChannels shown;
    for (const Channel channel : options.channels) shown.push_back(&debugMode(channel));
    if ((shown.empty() || options.debug_given || options.heat) &&
        std::ranges::count(options.channels, options.shown) == 0)
        shown.push_back(&debugMode(options.shown));
    return shown;
}

std::vector<Channel> channelsFor(OutputKind kind, const Options& options, std::vector<Channel> requested) {
    if (kind == OutputKind::exr) return requested;
    if (kind == OutputKind::png) requested.clear();
    for (const DebugMode* mode : shownChannels(options))
        if (std::ranges::count(requested, mode->channel) == 0) requested.push_back(mode->channel);
    for (const Channel needed : {Channel::lit, Channel::material_id})
        if (std::ranges::count(requested, needed) == 0) requested.push_back(needed);
    return requested;
}

void noteIgnored(const Options& options) {
    const Settings &given = options.settings, defaults;
    for (const Field& field : settingFields()) {
        const std::string_view why = ignoredBecause(given, field.option);
        if (!why.empty() && given.valueOf(field.option) != defaults.valueOf(field.option))
            note(options, fmt::format("--{} is not used: {}", field.option, why));
    }
}

nlohmann::ordered_json resultOf(const ReportDevice& made) {
    return {{"schema", 1},
            {"software", softwareName},
            {"device", {{"name", made.name}, {"driver", made.driver}, {"type", made.type}}},
            {"frames", nlohmann::ordered_json::array()}};
}

ReportDevice madeBy(const std::optional<Device>& device) {
    // Named in the files of a reference that needed no device.
    return device ? reportDevice(*device)
                  : ReportDevice{"double precision, no Vulkan device", softwareName, "cpu"};
}

double drawnShare(const RenderOptions& render) {
    return framesIn(render) / (framesIn(render) + 5);
}

std::string pictureNames(const std::vector<std::filesystem::path>& files) {
    std::string names;
    for (const std::filesystem::path& file : files)
        names += (names.empty() ? "" : ", ") + file.filename().string();
    return names;
}

}  // namespace diptych::cli
