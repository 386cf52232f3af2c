// SPDX-License-Identifier: MIT
#include "compare/cli/compare_many.h"

#include "compare/cli/commands.h"
#include "compare/cli/scene_comparison.h"
#include "compare/cli/scene_items.h"
#include "compare/cli/verdict_words.h"
#include "compare/explain/explanations.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/files/our_files.h"
#include "compare/render/reference_frame.h"
#include "compare/report/folders.h"
#include "compare/report/parts.h"
#include "compare/report/report.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "compare/shards/manifest.h"
#include "compare/verdict/pair_reports.h"
#include "shared/scene/load.h"
#include "shared/text/counted.h"
#include "shared/text/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The report's commands write beside the report instead of replacing it.
std::string againBeside(const fs::path& folder) {
    constexpr const char* name = "diptych-again";
    return folder.filename() == name ? std::string(name) + "-again" : name;
}

class Collection {
public:
    Collection(const Options& options, const std::vector<Settings>& settings, const fs::path& folder)
        : options_(options),
          settings_(settings),
          folder_(folder),
          picture_(pictureChoice(options)),
          compare_(compareOptions(options)),
          compared_(comparedOf(options)),
          items_(itemsOf(options, settings)),
          kept_(folder, "scenes", resumeKey(options, settings)),
          render_(judgedOptions(renderOptions(options), settings, isTraced(settings, {}),
                                !options.against_device.empty(), options.twice)),
          progress_(progressOutput(options)),
          device_(deviceOptions(options)),
          pipelines_(makePipelineSet(device_)),
          other_(againstDevice(options)),
          against_{other_ ? *other_ : device_, other_ ? makePipelineSet(*other_) : nullptr,
                   precisionsOf(device_, other_ ? *other_ : device_)} {}

    int run() {
        say(options_, "on " + device_.info().name + (other_ ? " and " + other_->info().name : ""));
        checkDevice();
        findKept();
        checkHeaders();
        sayWhenInterrupted(fmt::format(
            "finished scenes are kept in {}: the same command continues from there", kept_.path().string()));
        compareAll();
        sayWhenInterrupted("");
        return finish();
    }

private:
    // All parts of a report come from the same device, or the same two devices.
    void checkDevice() {
        Json device = Json::array();
        for (const Device* of : {&device_, other_.get()})
            if (of)
                for (const std::string& word : {of->info().name, of->info().driver, of->info().type})
                    device.push_back(word);
        const Json there = kept_.find("device");
        if (there.is_object() && there.value("device", Json()) != device)
            throw std::runtime_error(fmt::format(
                "{}: holds scenes rendered on another device ({}); remove it, or use that --device",
                kept_.path().string(), there["device"].dump()));
        kept_.keep("device", {{"device", device}});
    }

    void findKept() {
        for (const shards::Item* item : items_.mine) {
            if (kept_.find(shards::partOf(*item)) != shards::stampOf(item->scene) ||
                !isPartThere(kept_.path(), item->folder))
                continue;
            try {
                parts_.emplace(item, readPart(kept_.path(), item->folder));
            } catch (const std::runtime_error& problem) {
                note(options_, fmt::format("{}; comparing the scene again", problem.what()));
            }
        }
        if (!parts_.empty())
            note(options_, fmt::format("{} of {} scenes are kept from an interrupted run", parts_.size(),
                                       items_.mine.size()));
    }

    // A scene that fails becomes an error of the report.
    void attempt(const shards::Item* item, const std::function<void()>& work) {
        if (const std::optional<SceneError> error = shards::attempt(item->scene, work)) {
            errors_.emplace(item, *error);
            say(options_, fmt::format("{}; continuing with the other scenes", error->message));
        }
    }

    // Detects unreadable scenes before the long rendering starts.
    void checkHeaders() {
        for (const shards::Item* item : items_.mine)
            if (!parts_.contains(item))
                attempt(item, [&] { checkScene(item->scene, options_.settings.variant); });
    }

    void compareAll() {
        std::vector<const shards::Item*> left;
        for (const shards::Item* item : items_.mine)
            if (!parts_.contains(item) && !errors_.contains(item)) left.push_back(item);
        const auto all = static_cast<double>(items_.mine.size());
        auto done = all - static_cast<double>(left.size());
        // Loads the next scene while one is rendered.
        const auto load = [&](std::size_t i) {
            return std::async(std::launch::async, [this, name = left[i]->scene] {
                return loadShown(name, options_.settings, {});
            });
        };
        std::future<Scene> next;
        if (!left.empty()) next = load(0);
        for (std::size_t i = 0; i < left.size(); ++i, ++done) {
            const shards::Item* item = left[i];
            say(options_, item->scene);
            const Stage stage =
                Stage(progress_, item->scene).part(0.99 * done / all, 0.99 * (done + 1) / all);
            stage.at(0, "load");
            attempt(item, [&] {
                std::future<Scene> loading = std::move(next);
                loading.wait();
                if (i + 1 < left.size()) next = load(i + 1);
                const Scene scene = loading.get();
                parts_.emplace(item, compareOne(*item, scene, stage));
            });
        }
    }

    ReportPart compareOne(const shards::Item& item, const Scene& scene, const Stage& stage) {
        KeptReferences references(folder_, true);
        RenderOptions render = render_;
        render.keep = [&](std::uint64_t key, std::size_t floats) -> reference::Checkpoint& {
            return references.open(key, floats);
        };
        const auto [drawing, comparing] = experiment::sharesOf(render);
        const double ours = compared_.ourShare() * drawing;
        render.progress = stage.part(0, ours);
        experiment::DrawnScene drawn =
            experiment::drawScene(scene, compared_, settings_, device_, render, probe_,
                                  stage.part(ours, drawing), pipelines_, other_ ? &against_ : nullptr);
        checkValidation(device_);
        if (other_) checkValidation(*other_);
        Report report = experiment::reportOf(compared_, compare_, std::move(drawn), {}, reportDevice(device_),
                                             other_ ? reportDevice(*other_) : ReportDevice(),
                                             againBeside(folder_), stage.part(drawing, comparing));
        double explained = comparing;
        if (isExplained(options_.explain, report)) {
            explained = 0.5 * (1 + comparing);
            explainReport(options_, device_, report, stage.part(comparing, explained));
        }
        ReportPart part =
            writePart(report, kept_.path(), reportOptions(item.folder, stage.part(explained, 1)));
        // If an external renderer failed, the next run tries the scene again.
        if (report.errors.empty()) kept_.keep(shards::partOf(item), shards::stampOf(item.scene));
        for (const SceneError& error : report.errors) errors_.emplace(&item, error);
        references.remove();
        return part;
    }

    ReportOptions reportOptions(const std::optional<std::string>& scene_folder, const Stage& stage) const {
        return {picture_, options_.single_file, options_.keep, options_.force, stage, scene_folder};
    }

    int finish() {
        WholeReport whole;
        for (const shards::Item* item : items_.mine) {
            const auto [first, last] = errors_.equal_range(item);
            for (auto error = first; error != last; ++error) whole.errors.push_back(error->second);
            if (const auto part = parts_.find(item); part != parts_.end())
                whole.parts.push_back({std::move(part->second), kept_.path(), true});
        }
        if (whole.parts.empty() && options_.shard.empty())
            throw std::runtime_error(fmt::format("none of {} can be rendered; the first: {}",
                                                 counted(items_.all.size(), "scene"),
                                                 whole.errors.front().message));
        if (!options_.shard.empty())
            whole.shard = textOf(shards::Manifest{shards::buildName(), "compare", items_.plan, items_.shard,
                                                  items_.all, whole.errors});
        const Report summary = summaryOf(whole);
        ReportOptions report = reportOptions(std::nullopt, {});
        report.since = sinceOf(options_, summary, rowsOf(whole));
        writeWhole(whole, summary, folder_, report);
        kept_.remove();
        progress_.wipe();
        noteLeftByOthers(options_, KeptReferences(folder_, true));
        showWhole(options_, whole, summary, folder_, report.since.get(), true);
        sayErrors(summary.errors);
        return exitCodeOf(summary);
    }

    const Options& options_;
    const std::vector<Settings>& settings_;
    const fs::path folder_;
    const PictureChoice picture_;
    const CompareOptions compare_;
    const experiment::Compared compared_;
    const shards::SceneItems items_;
    CheckpointFolder kept_;
    const RenderOptions render_;
    Progress progress_;
    Device device_;
    const std::shared_ptr<PipelineSet> pipelines_;
    const std::unique_ptr<Device> other_;  // --against-device
    experiment::AgainstDevice against_;
    experiment::TextureProbe probe_;
    std::map<const shards::Item*, ReportPart> parts_;
    std::multimap<const shards::Item*, SceneError> errors_;  // of the scene or of external renderers
};

}  // namespace

int compareMany(const Options& options, const std::vector<Settings>& settings, const fs::path& folder) {
    if (!options.baseline_file.empty())
        throw std::runtime_error(fmt::format("--shard {}: --baseline {} holds one view; leave out --shard",
                                             options.shard, options.baseline_file.string()));
    if (options.single_file && !options.shard.empty())
        throw std::runtime_error(
            "--single-file: merge takes a shard's images from beside its page; leave it out");
    return Collection(options, settings, folder).run();
}

void showWhole(const Options& options, const WholeReport& whole, const Report& summary,
               const fs::path& folder, const Trends* since, bool all) {
    if (options.json) {
        InputFile report(folder / "report.json");
        printFile(report);
    } else if (!options.quiet) {
        const std::string exposures = wholeExposureLine(whole);
        printColored(options, fmt::format("{}{}{}report: {}\n", wholeTable(whole, summary, all),
                                          sinceText(since, summary),
                                          exposures.empty() ? "" : fmt::format("pictures: {}\n", exposures),
                                          (folder / "index.html").string()));
    }
}

int exitCodeOf(const Report& summary) {
    return !summary.errors.empty() ? 2 : summary.passed() ? 0 : 1;
}

}  // namespace diptych::cli
