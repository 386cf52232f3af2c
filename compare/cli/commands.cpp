// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"

#include "compare/files/output.h"
#include "compare/report/exposure_line.h"
#include "compare/report/titles.h"
#include "compare/run/print.h"
#include "shared/text/counted.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace diptych::cli {

namespace {

int listChannels(const Options& options) {
    if (options.json) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const DebugMode& mode : debugModes())
            list.push_back({{"number", channelNumber(mode.channel)},
                            {"name", mode.name},
                            {"metric", nameOf(mode.metric)},
                            {"shows", mode.shows}});
        printOut("{}\n", jsonText(list));
        return 0;
    }
    for (const DebugMode& mode : debugModes())
        printOut("{:>3}  {:<20} {:<9} {}\n", channelNumber(mode.channel), mode.name, nameOf(mode.metric),
                 mode.shows);
    return 0;
}

}  // namespace

int runCommand(const Options& options) {
    if (options.list_channels) return listChannels(options);
    constexpr std::pair<std::string_view, int (*)(const Options&)> commands[] = {
        {"compare", runCompare},   {"render", runRender},   {"diff", runDiff},
        {"tradeoff", runTradeoff}, {"explain", runExplain}, {"choose", runChoose},
        {"audit", runAudit},       {"bench", runBench},     {"plan", runPlan},
        {"devices", runDevices},   {"view", runView},       {"merge", runMerge},
        {"accept", runAccept},     {"submit", runSubmit},   {"calibrate", runCalibrate}};
    for (const auto& [name, run] : commands)
        if (name == options.command) return run(options);
    throw std::logic_error("no function of the command " + options.command);
}

std::filesystem::path outputFolder(const Options& options, const char* name, const char* what,
                                   const char* manifest) {
    const Output output = outputOf(options.out.empty() ? name : options.out, true);
    if (output.kind != OutputKind::folder)
        throw std::runtime_error(fmt::format("-o {}: the {} is a folder; give a name without an extension",
                                             output.path.string(), what));
    checkReplaceable(output, manifest, options.force);
    return output.path;
}

std::vector<Settings> settingsOf(const Options& options, const std::vector<Path>& paths) {
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
                if (const auto problem = settings.problem()) throw std::runtime_error(*problem);
                all.push_back(isReference(path) ? referenceSettings(settings) : settings);
            }
    return all;
}

std::optional<ProgressOutput> progressOutput(const Options& options) {
    return options.quiet ? std::nullopt : std::optional(ProgressOutput::standardError());
}

PictureChoice pictureChoice(const Options& options) {
    PictureChoice choice = options.picture;
    if (!options.match_exposure.empty()) choice.exposure = exposureOfFile(options.match_exposure);
    return choice;
}

RenderOptions renderOptions(const Options& options) {
    RenderOptions render;
    render.channels = options.channels;
    render.named = !options.channels.empty();
    if (render.channels.empty())
        for (const DebugMode& mode : debugModes()) render.channels.push_back(mode.channel);
    render.requested = render.channels;
    render.runs = options.runs;
    render.on_step = [&options](const std::string& step) { say(options, step); };
    return render;
}

DeviceOptions deviceOptions(const Options& options) {
    return {options.device, options.validate};
}

std::unique_ptr<Device> againstDevice(const Options& options) {
    if (options.against_device.empty()) return nullptr;
    return std::make_unique<Device>(DeviceOptions{options.against_device, options.validate});
}

void refuseOut(const Options& options) {
    if (!options.out.empty())
        throw std::runtime_error(fmt::format("-o {}: {} writes no file; use {} --json > FILE",
                                             options.out.string(), options.command, options.command));
}

void note(const Options& options, const std::string& line) {
    if (options.quiet) return;
    wipeProgress();
    printMessage(line);
}

void say(const Options& options, const std::string& line) {
    if (options.verbose) note(options, line);
}

void sayErrors(const std::vector<SceneError>& errors) {
    if (errors.empty()) return;
    wipeProgress();
    printMessage(errorText(errors.front()) +
                 (errors.size() == 1 ? "" : fmt::format("; and {} more", errors.size() - 1)));
}

void sayProblems(const Options& options, const std::vector<std::string>& problems,
                 const std::filesystem::path& page) {
    for (std::size_t i = 1; i < problems.size(); ++i) say(options, problems[i]);
    sayErrors(
        {{"",
          fmt::format("{}{}; {} shows the results so far", problems.front(),
                      problems.size() == 1 ? "" : fmt::format(" (and {} more, see -v)", problems.size() - 1),
                      page.string())}});
}

void printColored(const Options& options, const std::string& text) {
    printText(text, options.color);
}

void printLive(const Options& options, Progress& progress, const std::string& text) {
    if (options.json || options.quiet || std::ferror(stdout)) return;
    progress.wipe();
    printText(text);
    flushText();
}

std::shared_ptr<const Trends> sinceOf(const Options& options, const Report& report,
                                      const std::vector<IndexRow>& rows) {
    return options.since.empty() ? nullptr
                                 : std::make_shared<const Trends>(trendsSince(options.since, report, rows));
}

void checkSince(const Options& options) {
    if (options.since.empty()) return;
    if (!options.shard.empty())
        throw std::runtime_error("--since: a shard does not have all scenes; give --since to merge");
    trendsSince(options.since, {}, {});
}

std::string sinceText(const Trends* since, const Report& report) {
    std::string text;
    if (since)
        for (const std::string& line : trendLines(*since, report))
            text += fmt::format("since {}: {}\n", since->report, line);
    return text;
}

void noteLeftByOthers(const Options& options, const KeptReferences& kept) {
    if (const std::string line = kept.leftByOthers(); !line.empty()) note(options, line);
}

}  // namespace diptych::cli
