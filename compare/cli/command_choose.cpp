// SPDX-License-Identifier: MIT
#include "compare/choose/report.h"
#include "compare/cli/commands.h"
#include "compare/cli/scene_lab.h"
#include "compare/page/text.h"
#include "compare/render/frame_facts.h"
#include "compare/run/command_text.h"
#include "compare/run/version.h"
#include "compare/tradeoff/felt.h"
#include "compare/tradeoff/grid.h"
#include "compare/tradeoff/sweep.h"
#include "shared/image/atomic_file.h"
#include "shared/vulkan/pipeline_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace diptych::cli {

namespace {

using namespace choose;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Settings that an earlier choice left may be replaced, and nothing else without --force.
void checkSettingsFile(const std::filesystem::path& file, bool force) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || force) return;
    try {
        settingsFromJson({std::istreambuf_iterator<char>(stream), {}});
    } catch (const std::exception&) {
        throw std::runtime_error(
            fmt::format("-o {}: is there and holds no Settings; --force replaces it", file.string()));
    }
}

void checkChooseOptions(const Options& options) {
    const ChooseOptions& choose = options.choose;
    if (!choose.max_error && !choose.max_ms && !choose.max_bytes)
        throw std::runtime_error("choose: a budget is missing; give --max-error, --max-ms or --max-bytes");
    if (!options.out.empty() && options.out.extension() != ".json")
        throw std::runtime_error(fmt::format(
            "-o {}: the chosen Settings are a file; give a name that ends in .json", options.out.string()));
    if (!options.out.empty() && options.scenes.size() > 1)
        throw std::runtime_error(
            fmt::format("-o {}: holds the Settings of one scene; choose for each by itself, or give none",
                        options.out.string()));
    if (!options.out.empty()) checkSettingsFile(options.out, options.force);
    if (options.settings.path == Path::reference)
        throw std::runtime_error("--path reference: is what the others are measured against; use another");
    if (const auto problem = referenceSettings(options.settings).problem())
        throw std::runtime_error(*problem);
}

std::size_t figureOf(const std::string& name) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < tradeoff::errorFigures.size(); ++i) {
        if (tradeoff::errorFigures[i].name == name) return i;
        names.push_back(tradeoff::errorFigures[i].name);
    }
    throw std::runtime_error(fmt::format("--figure {}: takes {}", name, fmt::join(names, ", ")));
}

// What may be chosen: with --grid what that says, else what a sweep tries of what the scene feels.
std::vector<Settings> candidatesFor(const Options& options, const SceneView& view, const Scene& scene) {
    const Settings& given = options.settings;
    tradeoff::SweepRows sweep = tradeoff::makeSweepRows(
        given, options.grid.empty() ? tradeoff::usualGrids(given) : tradeoff::readGrids(options.grid, given));
    if (options.grid.empty()) sweep = tradeoff::rowsThatAreFelt(sweep, view.lights, &scene);
    // What the command line says comes first of its path: the others are told by what they change of it.
    std::ranges::stable_sort(sweep.rows, {},
                             [&](const Settings& row) { return tradeoff::choicesOf(row, given).size(); });
    return std::move(sweep.rows);
}

// A candidate of one path with changes; nothing where a sweep would not draw it.
std::optional<Settings> combined(const Settings& given, const Settings& first,
                                 std::span<const Change> changes) {
    tradeoff::Grid grid{{"path", {std::string(nameOf(first.path))}}};
    for (const Change& change : changes) grid.push_back({change.option, {change.to}});
    try {
        const tradeoff::SweepRows sweep = tradeoff::makeSweepRows(given, {grid});
        for (const Change& change : changes)
            if (sweep.rows.front().valueOf(change.option) != change.to) return {};
        return sweep.rows.front();
    } catch (const std::runtime_error&) {
        return {};
    }
}

std::vector<std::string> allCameras(const Scene& scene) {
    std::vector<std::string> cameras;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) cameras.push_back(std::to_string(i));
    return cameras.empty() ? std::vector<std::string>{""} : cameras;
}

// The scene's cameras that are not among `cameras`, which are named as the command line names them.
std::vector<std::string> unseenCameras(const Scene& scene, const std::vector<std::string>& cameras) {
    std::vector<std::string> unseen;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        if (std::ranges::count(cameras, std::to_string(i)) == 0 &&
            std::ranges::count(cameras, scene.cameras[i].name) == 0)
            unseen.push_back(std::to_string(i));
    return unseen;
}

class Chooser {
public:
    explicit Chooser(const Options& options)
        : options_(options),
          figure_(figureOf(options.choose.figure)),
          progress_(progressOutput(options)),
          device_(deviceOptions(options)),
          calibration_file_(calibrationFile(userCacheFolder(), device_.info().name)),
          calibration_(
              readCalibration(calibration_file_, device_.info().name, device_.info().driver, commitName())) {
        say(options, "on " + device_.info().name);
    }

    ChoiceReport choose(const std::string& where) {
        const Clock::time_point start = Clock::now();
        const Stage stage(progress_, where);
        const Scene scene = loadShown(where, options_.settings, stage.part(0, 0.05));
        SceneViews views(scene);
        const std::vector<std::string> cameras = options_.camera_given ? options_.cameras : allCameras(scene);
        Settings given = options_.settings;
        given.camera = cameras.front();
        Options asked = options_;
        asked.settings = given;
        const std::vector<Settings> candidates = candidatesFor(asked, views.at(viewRequest(given)), scene);

        ChoiceReport report;
        report.scene = where;
        report.notes = scene.notes;
        report.given = given;
        report.budget = {options_.choose.max_error, options_.choose.max_ms, options_.choose.max_bytes};
        report.figure = tradeoff::errorFigures.at(figure_).title;
        report.figure_name = tradeoff::errorFigures.at(figure_).name;
        report.device = reportDevice(device_);
        report.known_effects = calibration_.effects.size();

        Renderer renderer(device_, views);
        const Settings truth = tradeoff::truthFor(given, candidates);
        RenderOptions drawing = renderOptions(options_);
        drawing.progress = stage.part(0.05, 0.2).about(where + ": reference");
        const tradeoff::ReferenceFrames references =
            tradeoff::drawReferenceFrames(renderer, truth, cameras, pictureChoice(options_), drawing);
        for (const Frame& frame : references.frames) report.cameras.push_back(page::cameraTitle(frame));

        SceneLab lab(renderer, references, figure_, renderOptions(options_));
        CostModel model(calibration_);
        SearchOptions search;
        search.budget = report.budget;
        if (options_.grid.empty())
            search.combine = [&](const Settings& first, std::span<const Change> changes) {
                return combined(given, first, changes);
            };
        const Stage searching = stage.part(0.2, 0.95);
        search.progress = [&](double done, std::string_view what) { searching.at(done, std::string(what)); };
        report.choice = choose::search(candidates, lab, model, search);
        Calibration taught = calibration_;
        model.teach(taught, where);
        if (writeCalibration(calibration_file_, taught)) calibration_ = std::move(taught);

        for (const Candidate& candidate : report.choice.candidates) {
            report.words.push_back(tradeoff::inWords(tradeoff::choicesOf(candidate.settings, given)));
            Settings drawn = candidate.settings;
            drawn.camera = options_.settings.camera;
            report.commands.push_back(shellLine(commandWords("render", where, drawn)));
        }
        if (report.choice.chosen)
            for (const std::string& camera : unseenCameras(scene, cameras))
                report.unseen.push_back(fromUnseen(renderer, truth, report, camera));
        checkValidation(device_);
        report.seconds = secondsSince(start);
        progress_.wipe();
        return report;
    }

private:
    UnseenCamera fromUnseen(Renderer& renderer, const Settings& truth, const ChoiceReport& report,
                            const std::string& camera) {
        RenderOptions drawing = renderOptions(options_);
        drawing.progress = {};
        const tradeoff::ReferenceFrames references =
            tradeoff::drawReferenceFrames(renderer, truth, {camera}, pictureChoice(options_), drawing);
        SceneLab lab(renderer, references, figure_, drawing);
        const Candidate& chosen = report.choice.candidates[*report.choice.chosen];
        const double error = lab.judge(chosen.settings).error;
        const double most = report.budget.error ? *report.budget.error : 1.5 * chosen.judged->error;
        return {page::cameraTitle(references.frames.front()), error, error <= most};
    }

    const Options& options_;
    const std::size_t figure_;
    Progress progress_;
    Device device_;
    const std::filesystem::path calibration_file_;
    Calibration calibration_;
};

}  // namespace

int runChoose(const Options& options) {
    checkChooseOptions(options);
    Chooser chooser(options);
    nlohmann::ordered_json reports = nlohmann::ordered_json::array();
    bool fits = true;
    for (const std::string& scene : options.scenes) {
        const ChoiceReport report = chooser.choose(scene);
        fits = fits && report.choice.chosen;
        if (!options.out.empty() && report.choice.chosen) {
            Settings settings = report.choice.candidates[*report.choice.chosen].settings;
            settings.camera = options.settings.camera;
            writeFile(options.out, toJson(settings) + "\n");
        }
        if (options.json)
            reports.push_back(toJson(report));
        else if (!options.quiet)
            printColored(options, inWords(report));
    }
    if (options.json) fmt::print("{}\n", (reports.size() == 1 ? reports.front() : reports).dump(2));
    return fits ? 0 : 1;
}

}  // namespace diptych::cli
