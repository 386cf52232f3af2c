// SPDX-License-Identifier: MIT
#include "compare/cli/resolve_options.h"

#include "compare/audit/quantities.h"
#include "compare/audit/relations.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/picture_file.h"
#include "shared/text/did_you_mean.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace diptych::cli {

using namespace bench;

namespace {

Channel channelNamed(const std::string& word, const std::string& option) {
    if (const DebugMode* mode = findDebugMode(word)) return mode->channel;
    std::string all;
    std::vector<std::string> names;
    for (const DebugMode& mode : debugModes()) {
        names.emplace_back(mode.name);
        all += fmt::format("{}{} {}", all.empty() ? "" : ", ", channelNumber(mode.channel), mode.name);
    }
    throw std::runtime_error(
        fmt::format("{} {}: no such channel{}; there are {}", option, word, didYouMean(word, names), all));
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

Settings settingsFromFile(const std::string& file) {
    const std::string text = named("--settings " + file, [&] { return textIn(file, json_bytes); });
    return named(file, [&] { return settingsFromJson(text); });
}

Settings settingsOf(const ParsedOptions& parsed) {
    Settings settings;
    if (!parsed.settings_file.empty()) settings = settingsFromFile(parsed.settings_file);
    for (const auto& [option, value] : parsed.settings) settings.set(option, value);
    if (!parsed.cameras.empty()) settings.camera = parsed.cameras.front();
    return settings;
}

std::vector<std::string> pathNames() {
    std::vector<std::string> names;
    for (const auto& [path, name] : enumNames<Path>()) names.emplace_back(name);
    return names;
}

// One time of a --times list, s.
double timeOf(const std::string& word, const std::string& list) {
    Settings settings;
    try {
        settings.set("time", word);
    } catch (const std::runtime_error&) {
        throw std::runtime_error(
            fmt::format("--times {}: \"{}\" is not a time; give seconds, separated by commas", list, word));
    }
    if (settings.problem())
        throw std::runtime_error(fmt::format("--times {}: each time must be finite and at least 0 s", list));
    return settings.time;
}

void resolveTimes(Options& options, const ParsedOptions& parsed) {
    options.times = {options.settings.time};
    if (parsed.times) {
        const std::string& list = *parsed.times;
        options.times.clear();
        // <= size: a trailing comma yields an empty word, which is an error.
        for (std::size_t at = 0; at <= list.size();) {
            const std::size_t end = std::min(list.find(',', at), list.size());
            const std::string word = list.substr(at, end - at);
            const double time = timeOf(word, list);
            if (std::ranges::find(options.times, time) != options.times.end())
                throw std::runtime_error(fmt::format("--times {}: {} is given twice", list, word));
            options.times.push_back(time);
            at = end + 1;
        }
        options.settings.time = options.times.front();
    }
    options.frames = parsed.frames.value_or(options.frames);
    options.fps = parsed.fps.value_or(options.fps);
    if (!(options.fps > 0) || !std::isfinite(options.fps))
        throw std::runtime_error(fmt::format("--fps {}: must be above 0 and finite", options.fps));
    if (options.frames < 1)
        throw std::runtime_error(fmt::format("--frames {}: must be 1 or more", options.frames));
    if (options.frames > 1 && options.command != "render")
        throw std::runtime_error(fmt::format("--frames {}: only render takes it{}", options.frames,
                                             options.command == "compare" ? "; compare takes --times" : ""));
    if (parsed.fps && !parsed.frames)
        throw std::runtime_error(fmt::format("--fps {}: needs --frames N", options.fps));
    if (!std::isfinite(timeOfFrame(options, options.frames - 1)))
        throw std::runtime_error(
            fmt::format("--fps {}: the time of the last of {} frames is not finite; use a higher --fps",
                        options.fps, options.frames));
}

void resolveBaseline(Options& options, const ParsedOptions& parsed) {
    const auto path = std::ranges::find(enumNames<Path>(), parsed.baseline, &EnumName<Path>::name);
    const bool isPath = path != enumNames<Path>().end();
    if (isPath) options.baseline = path->value;
    const PictureName name = pictureName(parsed.baseline);
    if (!isPath && name.file.extension() != ".exr")
        throw std::runtime_error(
            fmt::format("--baseline {}: is not deferred, forward_plus, reference or an .exr file{}",
                        parsed.baseline, didYouMean(parsed.baseline, pathNames())));
    if (!isPath) options.baseline_file = parsed.baseline;
    if (options.update_baseline && (isPath || !name.part.empty()))
        throw std::runtime_error(
            "--update-baseline: needs --baseline FILE.exr (without ?part=), the file to replace");
}

void resolveTest(Options& options, const ParsedOptions& parsed) {
    for (const std::string& given : parsed.test) {
        const std::size_t at = given.find('=');
        if (at == std::string::npos || at == 0)
            throw std::runtime_error(
                fmt::format("--test {}: takes NAME=VALUE, for example gbuffer=compact", given));
        const std::string name = given.substr(0, at);
        if (std::ranges::none_of(settingFields(), [&](const Field& field) { return field.option == name; }))
            throw std::runtime_error(fmt::format("--test {}: there is no Setting {}", given, name));
        options.test.emplace_back(name, given.substr(at + 1));
    }
}

void resolveRenderers(Options& options, const ParsedOptions& parsed) {
    for (const std::string& words : parsed.renderers) {
        external::Renderer renderer = external::readRenderer(words);
        if (std::ranges::count(options.renderers, renderer.name, &external::Renderer::name) > 0)
            throw std::runtime_error(
                fmt::format("--renderer {}: two renderers have this name; give each its own", renderer.name));
        options.renderers.push_back(std::move(renderer));
        options.renderer_words.insert(options.renderer_words.end(), {"--renderer", words});
    }
}

void resolveWhatCounts(Options& options, const ParsedOptions& parsed) {
    PictureDiffOptions& diff = options.diff;
    if (!parsed.crop.empty()) options.selection.crop = diff.selection.crop = cropOf(parsed.crop);
    diff.metric = figureOfMetric(parsed.metric.empty() ? "flip" : parsed.metric);
    diff.metric_given = !parsed.metric.empty();
    if (diff.failing && diff.metric_given)
        throw std::runtime_error("--failing: counts pixels by the channel's own error; leave out --metric");
    if (!std::isfinite(diff.blur)) throw std::runtime_error("--blur: must be a finite number of pixels");
    const Figure& figure = *findFigure(diff.metric);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double identity = !figure.more_is_better ? 0 : figure.name == "ssim" ? 1 : infinity;
    diff.tolerance = parsed.tolerance.value_or(identity);
    diff.tolerance_given = parsed.tolerance.has_value();
    if (std::isnan(diff.tolerance) || (diff.tolerance < 0 && !figure.more_is_better))
        throw std::runtime_error(fmt::format("--tolerance {}: must be 0 or more", diff.tolerance));
    if (diff.failing && !parsed.tolerance)
        throw std::runtime_error("--failing: needs --tolerance T, the error above which a pixel fails");
}

void resolveBench(BenchOptions& bench, const ParsedOptions& parsed) {
    readList(bench, "--paths", parsed.bench_paths);
    readList(bench, "--assign", parsed.bench_assign);
    readList(bench, "--sizes", parsed.bench_sizes);
    readList(bench, "--transparencies", parsed.bench_transparencies);
    readList(bench, "--lightings", parsed.bench_lightings);
    readList(bench, "--light-counts", parsed.light_counts);
    readList(bench, "--axes", parsed.bench_axes);
    bench.max_ms = parsed.max_ms;
    if (!(parsed.max_ms > 0) || !std::isfinite(parsed.max_ms))
        throw std::runtime_error(fmt::format("--max-ms {}: must be above 0 and finite", parsed.max_ms));
    if (parsed.kernels != "off")
        throw std::runtime_error(
            fmt::format("--kernels {}: bench times frames alone; build/tests/bench_kernels times the kernels",
                        parsed.kernels));
    bench.table = benchTableOf(parsed.bench_table);
}

// Parses "64MiB". Empty for an empty word.
std::optional<std::uint64_t> bytesOf(const std::string& word) {
    if (word.empty()) return {};
    double number = -1;
    const char *const begin = word.data(), *const end = begin + word.size();
    const std::string_view rest(std::from_chars(begin, end, number).ptr, end);
    for (const auto& [unit, size] : {std::pair{"", 1.0}, {"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30}})
        if (rest == unit && number > 0 && number * size < 0x1p63)
            return static_cast<std::uint64_t>(number * size);
    throw std::runtime_error(
        fmt::format("--max-bytes {}: takes a number above 0, in bytes or with KiB, MiB or GiB", word));
}

void resolveChoose(ChooseOptions& choose, const ParsedOptions& parsed) {
    choose.max_bytes = bytesOf(parsed.max_bytes);
    if (choose.max_error && !(*choose.max_error >= 0 && std::isfinite(*choose.max_error)))
        throw std::runtime_error(
            fmt::format("--max-error {}: must be 0 or more and finite", *choose.max_error));
    if (choose.max_ms && !(*choose.max_ms > 0 && std::isfinite(*choose.max_ms)))
        throw std::runtime_error(fmt::format("--max-ms {}: must be above 0 and finite", *choose.max_ms));
}

void resolveAudit(AuditOptions& audit, const ParsedOptions& parsed) {
    audit::relationsOf(audit.chosen_relations);
    audit.relations = audit.relations || !audit.chosen_relations.empty();
    if (audit.relations && !audit.quantities.empty())
        throw std::runtime_error("--quantity: --relations stresses no quantity; give one of the two");
    if (audit.relations && !parsed.require.empty())
        throw std::runtime_error("--require: --relations stresses no quantity; give one of the two");
    audit::quantitiesOf(audit.quantities);  // throws for unknown names
    for (const std::string& words : parsed.require) {
        const std::size_t at = words.find('=');
        double magnitude = -1;
        const char* const end = words.data() + words.size();
        const char* const begin = at == words.npos ? end : words.data() + at + 1;
        if (std::from_chars(begin, end, magnitude).ptr != end || !(magnitude >= 0) ||
            !std::isfinite(magnitude))
            throw std::runtime_error(fmt::format(
                "--require {}: takes NAME=MAGNITUDE with MAGNITUDE 0 or more, for example offset=1e7",
                words));
        const std::string name = words.substr(0, at);
        audit::quantitiesOf(std::array{name}, "--require");
        audit.required.emplace_back(name, magnitude);
    }
}

Keep keepOf(const std::string& word) {
    for (const auto& [keep, name] :
         {std::pair{Keep::all, "all"}, {Keep::failing, "failing"}, {Keep::none, "none"}})
        if (word == name) return keep;
    throw std::runtime_error(fmt::format("--keep {}: takes all, failing or none", word));
}

Twice twiceOf(const std::string& word) {
    for (const auto& [twice, name] :
         {std::pair{Twice::all, "all"}, {Twice::lit, "lit"}, {Twice::none, "none"}})
        if (word == name) return twice;
    throw std::runtime_error(fmt::format("--twice {}: takes all, lit or none", word));
}

// "X,Y" in pixels from the top left.
Options::Pixel pixelOf(const std::string& words) {
    Options::Pixel pixel;
    const char *at = words.data(), *const end = at + words.size();
    const auto [comma, first] = std::from_chars(at, end, pixel.x);
    bool sound = first == std::errc() && comma != end && *comma == ',';
    if (sound) {
        const auto [last, second] = std::from_chars(comma + 1, end, pixel.y);
        sound = second == std::errc() && last == end && pixel.x >= 0 && pixel.y >= 0;
    }
    if (!sound)
        throw std::runtime_error(
            fmt::format("--pixel {}: takes X,Y in pixels from the top left, for example 320,180", words));
    return pixel;
}

}  // namespace

void resolve(Options& options, const ParsedOptions& parsed) {
    options.settings = settingsOf(parsed);
    options.sides = readSides(parsed.sides, options.settings);
    options.cameras = parsed.cameras.empty() ? std::vector{options.settings.camera} : parsed.cameras;
    options.camera_given = !options.settings.camera.empty();
    const auto isGiven = [&](std::string_view option) {
        return std::ranges::any_of(parsed.settings, [&](const auto& pair) { return pair.first == option; });
    };
    options.path_given = isGiven("path");
    options.size_given = isGiven("size") || !parsed.settings_file.empty();
    options.shadows_given = isGiven("shadows") || !parsed.settings_file.empty();
    options.debug_given = !parsed.debug.empty();
    if (options.debug_given) options.shown = channelNamed(parsed.debug, "--debug");
    if (options.heat) options.shown = Channel::light_count;
    if (parsed.channels != "all") options.channels = channelsNamed(parsed.channels);
    options.scene_given = !options.scenes.empty();
    for (const std::string& scene : options.scenes) refuseLineBreak(scene);
    if (options.scenes.empty()) options.scenes = {"builtin:gallery"};

    options.runs = parsed.runs.value_or(defaultRuns(options.command));
    if (options.runs < 0) throw std::runtime_error(fmt::format("--runs {}: must be 0 or more", options.runs));
    if (options.picture.exposure &&
        !(*options.picture.exposure > 0 && std::isfinite(*options.picture.exposure)))
        throw std::runtime_error(
            fmt::format("--exposure {}: must be above 0 and finite", *options.picture.exposure));
    if (options.picture.ev100 && !std::isfinite(*options.picture.ev100))
        throw std::runtime_error(fmt::format("--ev100 {}: must be finite", *options.picture.ev100));
    resolveTimes(options, parsed);
    options.keep = keepOf(parsed.keep);
    options.twice = twiceOf(parsed.twice);
    resolveBaseline(options, parsed);
    resolveTest(options, parsed);
    resolveRenderers(options, parsed);
    if (parsed.pixel) options.pixel = pixelOf(*parsed.pixel);
    resolveWhatCounts(options, parsed);
    resolveBench(options.bench, parsed);
    resolveChoose(options.choose, parsed);
    resolveAudit(options.audit, parsed);
}

}  // namespace diptych::cli
