// SPDX-License-Identifier: MIT
#include "compare/shards/collection.h"

#include "compare/frames/frame_properties.h"
#include "compare/render/load_scene.h"
#include "compare/render/reference_frame.h"
#include "shared/scene/load.h"

#include <fmt/format.h>

#include <future>
#include <optional>
#include <stdexcept>
#include <utility>

namespace diptych::shards {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The report's commands write beside the report instead of replacing it.
std::string againBeside(const fs::path& folder) {
    constexpr const char* name = "diptych-again";
    return folder.filename() == name ? std::string(name) + "-again" : name;
}

}  // namespace

std::map<const Item*, ReportPart> keptParts(const CheckpointFolder& checkpoints, const SceneItems& items,
                                            const std::function<void(const std::string&)>& note) {
    std::map<const Item*, ReportPart> parts;
    for (const Item* item : items.mine) {
        if (checkpoints.find(partOf(*item)) != stampOf(item->scene) ||
            !isPartThere(checkpoints.path(), item->folder))
            continue;
        try {
            parts.emplace(item, readPart(checkpoints.path(), item->folder));
        } catch (const std::runtime_error& problem) {
            note(fmt::format("{}; comparing the scene again", problem.what()));
        }
    }
    if (!parts.empty())
        note(
            fmt::format("{} of {} scenes are kept from an interrupted run", parts.size(), items.mine.size()));
    return parts;
}

Collection::Collection(const CollectionQuestion& question, const SceneItems& items, Device& device,
                       Device* other, Progress& progress)
    : question_(question),
      items_(items),
      progress_(progress),
      checkpoints_(question.folder, "scenes", question.key),
      devices_(device, other, true) {
    checkDevice();
    parts_ = keptParts(checkpoints_, items_, question_.note);
    checkHeaders();
}

// All parts of a report come from the same device, or the same two devices.
void Collection::checkDevice() {
    Json device = Json::array();
    for (const Device* of : devices_.all())
        for (const std::string& word : {of->info().name, of->info().driver, of->info().type})
            device.push_back(word);
    const Json there = checkpoints_.find("device");
    if (there.is_object() && there.value("device", Json()) != device)
        throw std::runtime_error(
            fmt::format("{}: holds scenes rendered on another device ({}); remove it, or use that --device",
                        checkpoints_.path().string(), there["device"].dump()));
    checkpoints_.keep("device", {{"device", device}});
}

// A scene that fails becomes an error of the report.
void Collection::attempt(const Item* item, const std::function<void()>& work) {
    if (const std::optional<SceneError> error = shards::attempt(item->scene, work)) {
        errors_.emplace(item, *error);
        question_.log_verbose(fmt::format("{}; continuing with the other scenes", error->message));
    }
}

// Detects unreadable scenes before the long rendering starts.
void Collection::checkHeaders() {
    for (const Item* item : items_.mine)
        if (!parts_.contains(item))
            attempt(item, [&] { checkScene(item->scene, question_.explanation.settings.variant); });
}

void Collection::compareAll() {
    std::vector<const Item*> left;
    for (const Item* item : items_.mine)
        if (!parts_.contains(item) && !errors_.contains(item)) left.push_back(item);
    const auto all = static_cast<double>(items_.mine.size());
    auto done = all - static_cast<double>(left.size());
    // Loads the next scene while one is rendered.
    const auto load = [&](std::size_t i) {
        return std::async(std::launch::async, [this, name = left[i]->scene] {
            return loadSceneWithSettings(name, question_.explanation.settings, {});
        });
    };
    std::future<Scene> next;
    if (!left.empty()) next = load(0);
    for (std::size_t i = 0; i < left.size(); ++i, ++done) {
        const Item* item = left[i];
        question_.log_verbose(item->scene);
        const Stage stage = Stage(progress_, item->scene).part(0.99 * done / all, 0.99 * (done + 1) / all);
        stage.at(0, "load");
        attempt(item, [&] {
            std::future<Scene> loading = std::move(next);
            loading.wait();
            if (i + 1 < left.size()) next = load(i + 1);
            const Scene scene = loading.get();
            if (!question_.compare.allow_empty) requireTriangles(scene, item->scene);
            parts_.emplace(item, compareOne(*item, scene, stage));
        });
    }
}

ReportPart Collection::compareOne(const Item& item, const Scene& scene, const Stage& stage) {
    ReferenceCheckpoints references(question_.folder, true);
    RenderOptions render = question_.drawing;
    render.keep = references.opener();
    const auto [drawing, comparing] = experiment::fractionsOf(render);
    const double drawn_part = question_.compared.pathsFraction() * drawing;
    render.progress = stage.part(0, drawn_part);
    experiment::DrawnScene drawn = experiment::drawScene(scene, question_.compared, question_.settings,
                                                         devices_, render, stage.part(drawn_part, drawing));
    for (const Device* of : devices_.all()) checkValidation(*of);
    CompareOptions compare = question_.compare;
    compare.progress = stage.part(drawing, comparing);
    Report report = experiment::reportOf(question_.compared, compare, std::move(drawn), {}, devices_,
                                         againBeside(question_.folder));
    double explained = comparing;
    if (isExplained(question_.explanation.all, report)) {
        explained = 0.5 * (1 + comparing);
        addExplanations(question_.explanation, devices_.device, report, stage.part(comparing, explained));
    }
    ReportOptions written = question_.report;
    written.progress = stage.part(explained, 1);
    written.scene_folder = item.folder;
    ReportPart part = writePart(report, checkpoints_.path(), written);
    // If an external renderer failed, the next run tries the scene again.
    if (report.errors.empty()) checkpoints_.keep(partOf(item), stampOf(item.scene));
    for (const SceneError& error : report.errors) errors_.emplace(&item, error);
    references.remove();
    return part;
}

WholeReport Collection::whole() {
    WholeReport whole;
    for (const Item* item : items_.mine) {
        const auto [first, last] = errors_.equal_range(item);
        for (auto error = first; error != last; ++error) whole.errors.push_back(error->second);
        if (const auto part = parts_.find(item); part != parts_.end())
            whole.parts.push_back({std::move(part->second), checkpoints_.path(), true});
    }
    return whole;
}

}  // namespace diptych::shards
