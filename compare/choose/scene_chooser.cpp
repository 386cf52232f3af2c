// SPDX-License-Identifier: MIT
#include "compare/choose/scene_chooser.h"

#include "compare/choose/variations.h"
#include "compare/experiment/evaluator.h"
#include "compare/experiment/grid.h"
#include "compare/experiment/sensitivity.h"
#include "compare/experiment/sweep.h"
#include "compare/frames/frame_properties.h"
#include "compare/page/text.h"
#include "compare/render/load_scene.h"
#include "compare/run/command_text.h"
#include "shared/draw/depth_storage.h"
#include "shared/text/joined_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace diptych::choose {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::function<void(double, std::string_view)> reporter(const Stage& stage) {
    return [stage](double done, std::string_view what) { stage.at(done, std::string(what)); };
}

// Candidates: the rows of --grid, or default rows limited to settings that the scene is sensitive to.
std::vector<Settings> candidatesFor(const std::string& grid, const Settings& requested, const Device& device,
                                    const SceneView& view, const Scene& scene) {
    experiment::SweepRows sweep =
        experiment::makeSweepRows(requested, grid.empty() ? experiment::defaultGrids(requested)
                                                          : experiment::readGrids(grid, requested));
    if (grid.empty()) sweep = experiment::sensitiveRows(sweep, view.lights, &scene);
    sweep = experiment::withoutRefused(std::move(sweep), requested,
                                       [&](const Settings& row) { return drawingProblem(device, row); });
    // For each path, Settings of the command line come first: other rows are described as changes to them.
    std::ranges::stable_sort(
        sweep.rows, {}, [&](const Settings& row) { return experiment::changesOf(row, requested).size(); });
    return std::move(sweep.rows);
}

// Settings with further changes; empty if a sweep would not render them.
std::optional<Settings> combined(const Settings& requested, const Settings& of,
                                 std::span<const Change> changes) {
    experiment::Grid grid;
    for (const experiment::Change& choice : experiment::changesOf(of, requested))
        if (std::ranges::count(changes, choice.option, &Change::option) == 0)
            grid.push_back({choice.option, {choice.value}});
    for (const Change& change : changes) grid.push_back({change.option, {change.value}});
    try {
        const experiment::SweepRows sweep = experiment::makeSweepRows(requested, {grid});
        for (const Change& change : changes)
            if (sweep.rows.front().valueOf(change.option) != change.value) return {};
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

// The scene's cameras that are not in `cameras`. `cameras` has indices or names, as on the command line.
std::vector<std::string> heldOutCameras(const Scene& scene, const std::vector<std::string>& cameras) {
    std::vector<std::string> held_out;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        if (std::ranges::count(cameras, std::to_string(i)) == 0 &&
            std::ranges::count(cameras, scene.cameras[i].name) == 0 &&
            std::ranges::count(cameras, scene.cameras[i].node_name) == 0)
            held_out.push_back(std::to_string(i));
    return held_out;
}

// Changes of the candidates that differ from the first of their path in one Setting.
std::vector<Change> singleChanges(const std::vector<Settings>& candidates) {
    std::vector<Change> single;
    for (const Settings& row : candidates) {
        const Settings& first = *std::ranges::find(candidates, row.path, &Settings::path);
        const std::vector<Change> changes = changesBetween(first, row);
        if (changes.size() == 1) single.push_back(changes.front());
    }
    return single;
}

}  // namespace

Measure metricNamed(const std::string& name) {
    for (std::size_t i = 0; i < experiment::errorMetrics.size(); ++i)
        if (experiment::errorMetrics[i].name == name) return Measure::flip + i;
    throw std::runtime_error(
        fmt::format("--figure {}: takes {}", name, joinedNames(experiment::errorMetrics)));
}

struct SceneChooser::LoadedScene {
    LoadedScene(std::string name, Scene read, Device& device, const std::shared_ptr<PipelineSet>& pipelines)
        : where(std::move(name)), scene(std::move(read)), views(scene), renderer(device, views, pipelines) {}
    std::string where;
    Scene scene;
    SceneViews views;
    Renderer renderer;
    std::optional<experiment::SceneEvaluator> evaluator{};
};

SceneChooser::SceneChooser(const Question& question, Device& device, Progress& progress)
    : question_(question), progress_(progress), device_(device), pipelines_(makePipelineSet(device_)) {}

SceneChooser::~SceneChooser() = default;

SceneChooser::LoadedScene& SceneChooser::load(const std::string& scene, const Stage& progress) {
    if (loaded_ && loaded_->where == scene) return *loaded_;
    if (loaded_)
        if (const auto before = references_.find(loaded_->where); before != references_.end())
            for (const auto& errors : before->second.errors) errors->release();
    loaded_.reset();
    loaded_ = std::make_unique<LoadedScene>(scene, loadSceneWithSettings(scene, question_.settings, progress),
                                            device_, pipelines_);
    if (const auto references = references_.find(scene); references != references_.end())
        loaded_->evaluator.emplace(loaded_->renderer, references->second, question_.budget.metric,
                                   question_.drawing);
    return *loaded_;
}

SettingsChoice SceneChooser::search(LoadedScene& loaded, const Settings& requested,
                                    const std::vector<Settings>& candidates, const Stage& progress) const {
    SearchOptions options;
    options.budget = question_.budget;
    options.changes = singleChanges(candidates);
    options.combine = [&](const Settings& of, std::span<const Change> changes) -> std::optional<Settings> {
        std::optional<Settings> made = combined(requested, of, changes);
        const bool drawn = question_.grid.empty() ? made && !drawingProblem(device_, *made)
                                                  : made && std::ranges::count(candidates, *made) > 0;
        return drawn ? made : std::nullopt;
    };
    options.progress = reporter(progress);
    return choose::search(tableOf(candidates), *loaded.evaluator, options);
}

ChoiceReport SceneChooser::choose(const std::string& where) {
    const Clock::time_point start = Clock::now();
    const Stage stage(progress_, where);
    LoadedScene& loaded = load(where, stage.part(0, 0.05));
    const std::vector<std::string> cameras =
        question_.cameras.empty() ? allCameras(loaded.scene) : question_.cameras;
    Settings requested = question_.settings;
    requested.camera = cameras.front();
    const std::vector<Settings> candidates = candidatesFor(
        question_.grid, requested, device_, loaded.views.at(viewRequest(requested)), loaded.scene);

    ChoiceReport report;
    report.scene = where;
    report.notes = loaded.scene.notes;
    report.requested = requested;
    report.budget = question_.budget;
    report.device = reportDevice(device_);

    const Settings truth = experiment::referenceFor(requested, candidates);
    RenderOptions drawing = question_.drawing;
    drawing.progress = stage.part(0.05, 0.2).about(where + ": reference");
    const experiment::ReferenceFrames& references =
        references_
            .insert_or_assign(where, experiment::drawReferenceFrames(loaded.renderer, truth, cameras,
                                                                     question_.image, drawing, false))
            .first->second;
    for (const Frame& frame : references.frames) report.cameras.push_back(page::cameraTitle(frame));
    experiment::addNotes(report.notes, references, candidates, loaded.views.at(viewRequest(requested)).needs);
    loaded.evaluator.emplace(loaded.renderer, references, question_.budget.metric, question_.drawing);

    report.choice = search(loaded, requested, candidates, stage.part(0.2, 0.95));

    for (Candidate& candidate : report.choice.candidates) {
        candidate.scene = where;
        candidate.judgement = candidate.statusName().word;
        describe(report, candidate.settings, where);
    }
    loaded.evaluator->release();  // frees memory for other evaluators
    if (report.choice.chosen)
        for (const std::string& camera : heldOutCameras(loaded.scene, cameras))
            report.held_out.push_back(atHeldOut(loaded, truth, report, camera));
    if (question_.explain && report.choice.chosen)
        report.sensitivities = sensitivityOf(loaded, report, stage.part(0.95, 1));
    checkValidation(device_);
    report.seconds = secondsSince(start);
    progress_.wipe();
    return report;
}

void SceneChooser::describe(AnyReport& report, Settings& candidate, const std::string& scene) const {
    report.words.push_back(experiment::describe(experiment::changesOf(candidate, report.requested)));
    candidate.camera = question_.settings.camera;
    report.commands.push_back(shellLine(commandArguments("render", scene, candidate)));
}

std::optional<SensitivityReport> SceneChooser::sensitivityOf(LoadedScene& loaded, const ChoiceReport& report,
                                                             const Stage& progress) {
    const SettingsChoice& choice = report.choice;
    const Candidate& chosen = choice.candidates[*choice.chosen];
    const Path chosen_path = chosen.settings.path;
    // The other path's best candidate, or its most accurate one if none fits the budget.
    std::optional<std::size_t> other = bestOfOtherPath(choice, report.budget);
    const bool fits = other.has_value();
    for (std::size_t i = 0; i < choice.candidates.size() && !fits; ++i)
        if (const Candidate& candidate = choice.candidates[i];
            candidate.isEvaluated() && candidate.settings.path != chosen_path &&
            (!other || candidate[report.budget.metric] < choice.candidates[*other][report.budget.metric]))
            other = i;
    if (!other) return {};  // --grid has candidates of one path only
    // Without blended pixels the candidates may differ in transparency settings. Equalize these, because
    // variations may add blending.
    std::array<Settings, 2> compared{chosen.settings, choice.candidates[*other].settings};
    const experiment::ReferenceFrames& references = references_.at(report.scene);
    if (std::ranges::all_of(references.frames,
                            [](const Frame& frame) { return frame.blended.pixels() == 0; }))
        for (const Field& field : settingFields())
            for (Settings& each : compared)
                if (field.option.starts_with("transparency"))
                    each.set(field.option, question_.settings.valueOf(field.option));
    const VariedScene varied{device_, pipelines_, loaded.views, loaded.renderer, references, compared};
    constexpr int rounds = 5;
    return SensitivityReport{
        analyzeSensitivity(drawAsIs(varied), propertiesOf(varied), rounds, reporter(progress)),
        report.words[*choice.chosen],
        report.words[*other],
        std::string(nameOf(chosen_path)),
        std::string(nameOf(compared[1].path)),
        fits};
}

HeldOutCamera SceneChooser::atHeldOut(LoadedScene& loaded, const Settings& truth, const ChoiceReport& report,
                                      const std::string& camera) {
    RenderOptions drawing = question_.drawing;
    drawing.progress = {};
    const experiment::ReferenceFrames references =
        experiment::drawReferenceFrames(loaded.renderer, truth, {camera}, question_.image, drawing, false);
    experiment::SceneEvaluator evaluator(loaded.renderer, references, question_.budget.metric, drawing);
    const Candidate& chosen = report.choice.candidates[*report.choice.chosen];
    const double error = evaluator.evaluate(chosen.settings)[question_.budget.metric];
    const double max = report.budget.error ? *report.budget.error : 1.5 * chosen[report.budget.metric];
    return {page::cameraTitle(references.frames.front()), error, error <= max};
}

JointReport SceneChooser::chooseJointly(const std::vector<ChoiceReport>& reports) {
    const Clock::time_point start = Clock::now();
    const Stage stage(progress_, fmt::format("all {} scenes", reports.size()));
    std::vector<const SettingsChoice*> own;
    JointReport all;
    for (const ChoiceReport& report : reports) {
        own.push_back(&report.choice);
        all.scenes.push_back(report.scene);
    }
    JointOptions options;
    options.budget = question_.budget;
    options.progress = reporter(stage);
    const std::function<Evaluator&(std::size_t)> evaluatorOf = [&](std::size_t scene) -> Evaluator& {
        return *load(reports[scene].scene, Stage()).evaluator;
    };
    all.choice = choose::chooseJointly(own, evaluatorOf, options);
    all.requested = question_.settings;
    all.requested.camera.clear();
    all.budget = question_.budget;
    for (JointCandidate& candidate : all.choice.candidates) {
        for (std::size_t scene = 0; scene < candidate.scenes.size(); ++scene) {
            candidate.scenes[scene].scene = all.scenes[scene];
            candidate.scenes[scene].judgement = candidate.fits ? "fits all scenes" : "not for all scenes";
        }
        describe(all, candidate.settings, "SCENE");
    }
    checkValidation(device_);
    all.seconds = secondsSince(start);
    progress_.wipe();
    return all;
}

}  // namespace diptych::choose
