// SPDX-License-Identifier: MIT
#include "compare/choose/report.h"
#include "compare/choose/scene_chooser.h"
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/exit_code.h"
#include "compare/cli/option_groups.h"
#include "compare/files/linked_file.h"
#include "compare/files/scene_folders.h"
#include "compare/output/writers.h"
#include "compare/run/print.h"
#include "shared/image/atomic_file.h"
#include "shared/text/input_file.h"
#include "shared/text/joined_names.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"

#include <charconv>
#include <cmath>

namespace diptych::cli {

namespace {

using namespace choose;

struct ChooseLine : SceneGroup, GridGroup, Budget {
    std::string metric_text = "flip";  // name in experiment::errorMetrics
    std::string bytes_text;
    bool explain = false;  // --explain-choice
};

void describeChoose(CLI::App& app, ChooseLine& options) {
    addScene(app, options, many_scenes_help);
    addFiles(app, options,
             "X.json: the chosen Settings (several scenes: one choice for all); any other name: folder with "
             "a page, choice.json and settings.json; without -o: no files");
    addGrid(app, options, "each Setting alone, and helpful combinations");
    addOutput(app, options);
    app.option_defaults()->group("Budgets (one or two)");
    addOption(app, "--max-error", options.error, "E",
              "largest error of lit; finds the fastest Settings within it");
    addOption(app, "--figure", options.metric_text, joinedNames(experiment::errorMetrics, "|"),
              "error metric of --max-error (flip)");
    addOption(app, "--max-ms", options.ms, "T",
              "longest frame time, ms; without --max-error, finds the most accurate Settings within it");
    addOption(app, "--max-bytes", options.bytes_text, "B",
              "largest memory of a frame: bytes, or a number with KiB, MiB or GiB");
    app.add_flag("--explain-choice", options.explain,
                 "explain the choice of path: the effect of overdraw, lights per pixel, transparency, "
                 "samples, materials, triangles and size, and the value at which each would reverse the "
                 "choice; renders a few hundred more frames");
    acceptUnread(app, {"--path", "--runs"});
    acceptUnread(app, image_group);
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
    refuse("--max-bytes {}: takes a number above 0, in bytes or with KiB, MiB or GiB", word);
}

void resolveChoose(ChooseLine& options) {
    resolveScene(options);
    options.bytes = bytesOf(options.bytes_text);
    if (options.error && !(*options.error >= 0 && std::isfinite(*options.error)))
        refuse("--max-error {}: must be 0 or more and finite", *options.error);
    if (options.ms && !(*options.ms > 0 && std::isfinite(*options.ms)))
        refuse("--max-ms {}: must be above 0 and finite", *options.ms);
}

bool isSettingsFile(const std::filesystem::path& out) {
    return out.extension() == ".json";
}

// Without --force only a file of Settings may be replaced.
void checkSettingsFile(const std::filesystem::path& file, bool force) {
    std::error_code ignored;
    if (force || !std::filesystem::exists(file, ignored)) return;
    try {
        settingsFromJson(textIn(file, json_bytes));
    } catch (const std::exception&) {
        refuse("-o {}: exists and does not contain Settings; --force replaces it", file.string());
    }
}

void checkChooseOptions(const ChooseLine& options) {
    if (!options.error && !options.ms && !options.bytes)
        refuse("choose: a budget is missing; give --max-error, --max-ms or --max-bytes");
    if (isSettingsFile(options.out))
        checkSettingsFile(options.out, options.force);
    else if (!options.out.empty())
        outputFolder(options, "", "choice (X.json: only its Settings)", choiceManifest);
    checkMeasured(options.settings);
}

Question questionOf(const ChooseLine& options) {
    return {options.settings,    options.camera_requested ? options.cameras : std::vector<std::string>(),
            options.grid,        {metricNamed(options.metric_text), options.error, options.ms, options.bytes},
            options.explain,     renderOptions(options),
            imageChoice(options)};
}

int runChoose(const ChooseLine& options) {
    checkChooseOptions(options);
    const std::vector<std::string> scenes = scenesOf(options.scenes);
    const Question question = questionOf(options);
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    logVerbose(options, "on " + device.info().name);
    SceneChooser chooser(question, device, progress);
    Choices choices;
    const auto tell = [&](const std::string& text) {
        if (!options.json && !options.quiet) printColored(options, text);
    };
    for (const std::string& scene : scenes) {
        choices.scenes.push_back(chooser.choose(scene));
        tell(inText(blocksOf(choices.scenes.back())));
    }
    if (scenes.size() > 1) {
        choices.all = chooser.chooseJointly(choices.scenes);
        tell(inText(blocksOf(*choices.all)));
    }
    std::optional<Settings> settings = chosenSettings(choices);
    if (settings) settings->camera = options.settings.camera;
    if (isSettingsFile(options.out)) {
        if (settings) writeFile(linkedFile(options.out), toJson(*settings) + "\n");
    } else if (!options.out.empty()) {
        writeChoice(choices, options.out, options.force);
        tell((options.out / "index.html").string() + "\n");
    }
    if (options.json) printOut("{}\n", jsonText(toJson(choices)));
    return exitCode(settings.has_value());
}

}  // namespace

Command chooseCommand() {
    return makeCommand<ChooseLine>({"choose",
                                    "Finds the fastest Settings within an error budget, or the most accurate "
                                    "within a time or memory budget",
                                    "diptych choose helmet.glb --max-error 0.02 -o helmet-choice",
                                    "max-error max-ms max-bytes figure grid lights size device out json"},
                                   describeChoose, resolveChoose, runChoose);
}

}  // namespace diptych::cli
