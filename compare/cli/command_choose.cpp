// SPDX-License-Identifier: MIT
#include "compare/choose/report.h"
#include "compare/choose/scene_chooser.h"
#include "compare/cli/commands.h"
#include "compare/files/linked_file.h"
#include "compare/files/scene_folders.h"
#include "compare/output/writers.h"
#include "compare/run/print.h"
#include "shared/image/atomic_file.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace diptych::cli {

namespace {

using namespace choose;

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
        throw std::runtime_error(
            fmt::format("-o {}: exists and does not contain Settings; --force replaces it", file.string()));
    }
}

void checkChooseOptions(const Options& options) {
    const ChooseOptions& choose = options.choose;
    if (!choose.max_error && !choose.max_ms && !choose.max_bytes)
        throw std::runtime_error("choose: a budget is missing; give --max-error, --max-ms or --max-bytes");
    if (isSettingsFile(options.out))
        checkSettingsFile(options.out, options.force);
    else if (!options.out.empty())
        outputFolder(options, "", "choice (X.json: only its Settings)", choiceManifest);
    if (isReference(options.settings.path))
        throw std::runtime_error(
            "--path reference: errors are measured against it; use deferred or forward_plus");
    if (const auto problem = referenceSettings(options.settings).problem())
        throw std::runtime_error(*problem);
}

Question questionOf(const Options& options) {
    const ChooseOptions& choose = options.choose;
    return {options.settings,
            options.camera_given ? options.cameras : std::vector<std::string>(),
            options.grid,
            {figureNamed(choose.figure), choose.max_error, choose.max_ms, choose.max_bytes},
            choose.explain,
            renderOptions(options),
            pictureChoice(options)};
}

}  // namespace

int runChoose(const Options& options) {
    checkChooseOptions(options);
    const std::vector<std::string> scenes = scenesOf(options.scenes);
    const Question question = questionOf(options);
    Progress progress(progressOutput(options));
    Device device(deviceOptions(options));
    say(options, "on " + device.info().name);
    SceneChooser chooser(question, device, progress);
    Choices choices;
    const auto tell = [&](const std::string& words) {
        if (!options.json && !options.quiet) printColored(options, words);
    };
    for (const std::string& scene : scenes) {
        choices.scenes.push_back(chooser.choose(scene));
        tell(inText(blocksOf(choices.scenes.back())));
    }
    if (scenes.size() > 1) {
        choices.all = chooser.chooseForAll(choices.scenes);
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
    return settings ? 0 : 1;
}

}  // namespace diptych::cli
