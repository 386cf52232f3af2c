// SPDX-License-Identifier: MIT
#include "compare/cli/command_line.h"

#include "compare/cli/command_options.h"
#include "compare/run/version.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace diptych::cli {

using namespace bench;

namespace {

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

Settings settingsOf(const ParsedOptions& said) {
    Settings settings;
    if (!said.settings_file.empty()) settings = settingsFromFile(said.settings_file);
    for (const auto& [option, value] : said.settings) settings.set(option, value);
    if (!said.cameras.empty()) settings.camera = said.cameras.front();
    return settings;
}

void resolveBaseline(Options& options, const ParsedOptions& said) {
    const auto path =
        std::ranges::find(enumNames<Path>(), said.baseline, &std::pair<Path, std::string_view>::second);
    const bool isPath = path != enumNames<Path>().end();
    if (isPath) options.baseline = path->first;
    if (!isPath && !said.baseline.ends_with(".exr"))
        throw std::runtime_error(fmt::format(
            "--baseline {}: is none of deferred, forward_plus, reference, and no .exr file", said.baseline));
    if (!isPath) options.baseline_file = said.baseline;
    if (options.update_baseline && isPath)
        throw std::runtime_error("--update-baseline: --baseline FILE.exr says which file");
}

void resolveWhatCounts(Options& options, const ParsedOptions& said) {
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

void resolveBench(BenchOptions& bench, const ParsedOptions& said) {
    if (!said.bench_paths.empty()) bench.paths = benchPaths(said.bench_paths);
    if (!said.bench_assign.empty()) bench.assign = benchAssignments(said.bench_assign);
    if (!said.bench_sizes.empty()) bench.sizes = benchSizes(said.bench_sizes);
    if (!said.light_counts.empty()) bench.light_counts = benchLightCounts(said.light_counts);
    bench.max_ms = said.max_ms;
    if (!(said.max_ms > 0) || !std::isfinite(said.max_ms))
        throw std::runtime_error(fmt::format("--max-ms {}: above 0, finite", said.max_ms));
    if (said.kernels != "on" && said.kernels != "off" && said.kernels != "only")
        throw std::runtime_error(fmt::format("--kernels {}: takes on, off or only", said.kernels));
    bench.kernels = said.kernels != "off";
    bench.frames = said.kernels != "only";
}

// What each word means together with the others.
void resolve(Options& options, const ParsedOptions& said) {
    options.settings = settingsOf(said);
    options.cameras = said.cameras.empty() ? std::vector{options.settings.camera} : said.cameras;
    options.path_given =
        std::ranges::any_of(said.settings, [](const auto& pair) { return pair.first == "path"; });
    options.debug_given = !said.debug.empty();
    if (options.debug_given) options.shown = channelNumber(said.debug, "--debug");
    if (options.heat) options.shown = static_cast<int>(gpu::DEBUG_light_count);
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
    resolveBench(options.bench, said);
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
    ParsedOptions said;

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
    for (const Command& command : allCommands()) {
        CLI::App& sub =
            *app.add_subcommand(command.name, command.does + (command.built ? "" : " (not built yet)"));
        sub.footer("Example: " + command.example);
        describe(sub, command.name, options, said);
    }

    const auto known = [&](const Command& command) { return command.name == words.front(); };
    if (words.empty()) throw std::runtime_error("a command is missing; see diptych --help");
    if (!words.front().starts_with('-') && std::ranges::none_of(allCommands(), known))
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
    const auto command = std::ranges::find(allCommands(), options.command, &Command::name);
    if (!command->built) throw std::runtime_error(options.command + " is not built yet");
    resolve(options, said);
    return options;
}

}  // namespace diptych::cli
