// SPDX-License-Identifier: MIT
#include "compare/cli/commands.h"
#include "compare/cli/tradeoff_many.h"
#include "compare/external/external_frame.h"
#include "compare/files/our_files.h"
#include "compare/files/output.h"
#include "compare/files/scene_folders.h"
#include "compare/render/frame_facts.h"
#include "compare/render/reference_frame.h"
#include "compare/run/color.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "compare/run/version.h"
#include "compare/tradeoff/grid.h"
#include "compare/tradeoff/measure.h"
#include "compare/tradeoff/sensitivity.h"
#include "compare/tradeoff/sweep_state.h"
#include "compare/tradeoff/tradeoff.h"
#include "shared/contract/debug_mode.h"
#include "shared/draw/depth_storage.h"
#include "shared/text/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <span>
#include <stdexcept>

namespace diptych::cli {

using namespace tradeoff;

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void checkTradeoffOptions(const Options& options) {
    if (options.runs < 1) throw std::runtime_error("--runs 0: tradeoff measures times; use 1 or more");
    if (isReference(options.settings.path))
        throw std::runtime_error(
            "--path reference: errors are measured against it; use deferred or forward_plus");
    if (const auto problem = referenceSettings(options.settings).problem())
        throw std::runtime_error(*problem);
}

// Inputs of a row besides its Settings. The reference's fingerprint identifies the visible contents; the
// file's size and time detect other changes.
Json keyOf(const Options& options, const Tradeoff& tradeoff, const ReferenceFrames& references) {
    const std::string& scene = options.scenes.front();
    std::error_code error;
    Json file = nullptr;
    if (const auto size = std::filesystem::file_size(scene, error); !error)
        file = {size, std::filesystem::last_write_time(scene, error).time_since_epoch().count()};
    return {{"schema", 1},
            {"software", softwareName},
            {"commit", commitName()},
            {"scene", scene},
            {"file", file},
            {"truth", fingerprint(references)},
            {"settings", parseOrderedJson(toJson(tradeoff.reference))},
            {"cameras", options.cameras},
            {"exposure", references.exposure.factor},
            {"tonemap", references.exposure.tonemap},
            {"runs", options.runs},
            {"device", tradeoff.device.name},
            {"driver", tradeoff.device.driver}};
}

// Relative cost of a row, pixels, for the progress line.
double weightOf(const Settings& settings) {
    return static_cast<double>(settings.size.width) * settings.size.height;
}

// Timed frames in each timing block of a row. The first block runs when the row is rendered, the others
// after all rows.
std::vector<int> blockSizes(int runs) {
    constexpr int most = 5;  // each block allocates the row's images again
    const int at_once = std::max(4, (runs + most - 1) / most);
    std::vector<int> blocks{std::min((runs + 1) / 2, at_once)};
    for (int left = runs - blocks.front(); left > 0; left -= blocks.back())
        blocks.push_back(std::min(left, at_once));
    return blocks;
}

class Sweep {
public:
    Sweep(const Options& options, SweepRows sweep)
        : options_(options),
          sweep_(std::move(sweep)),
          folder_(outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoffManifest)),
          references_(folder_, true),
          progress_(progressOutput(options)),
          device_(deviceOptions(options)) {
        say(options, "on " + device_.info().name);
        sweep_ = withoutRefused(std::move(sweep_), options.settings,
                                [&](const Settings& row) { return drawingProblem(device_, row); });
        tradeoff_.scene = options.scenes.front();
        tradeoff_.cameras = options.cameras;
        tradeoff_.given = referenceFor(options.settings, sweep_.rows);
        tradeoff_.reference = referenceSettings(tradeoff_.given);
        tradeoff_.device = reportDevice(device_);
        tradeoff_.runs = options.runs;
    }

    int run() {
        const RenderOptions render = renderOptions(options_);
        const double loading =
            loadingShare(tradeoff_.scene, render, sweep_.rows.size() * options_.cameras.size());
        const Stage stage(progress_, tradeoff_.scene);
        const Scene scene = loadShown(tradeoff_.scene, options_.settings, stage.part(0, loading));
        tradeoff_.notes = scene.notes;
        stage.at(loading, "upload");
        SceneViews views(scene);
        if (options_.grid.empty())
            sweep_ = sensitiveRows(sweep_, views.at(viewRequest(options_.settings)).lights, &views.scene());
        tradeoff_.skips = sweep_.skips;
        Renderer renderer(device_, views);
        tradeoff_.cost.reading = msSince(start_);
        const double referenceDone = loading + (1 - loading) / static_cast<double>(sweep_.rows.size() + 1);
        const Clock::time_point uploaded = Clock::now();
        RenderOptions drawing = render;
        drawing.progress = stage.part(loading, referenceDone).about(tradeoff_.scene + ": reference");
        drawing.keep = [this](std::uint64_t key, std::size_t floats) -> reference::Checkpoint& {
            return references_.open(key, floats);
        };
        const ReferenceFrames references = drawReferenceFrames(renderer, tradeoff_.given, options_.cameras,
                                                               pictureChoice(options_), drawing);
        tradeoff_.cost.reference = msSince(uploaded);
        addNotes(tradeoff_.notes, references, sweep_.rows, views.at(viewRequest(options_.settings)).needs);
        SweepState state(folder_, keyOf(options_, tradeoff_, references));
        if (state.isRenewed())
            note(options_,
                 "the results of an interrupted sweep belong to another scene, device or Settings; starting "
                 "anew");
        sayWhenInterrupted(fmt::format("finished rows are kept in {}: the same command continues from there",
                                       SweepState::folderOf(folder_).string()));
        const double drawn =
            referenceDone + (0.98 - referenceDone) * 0.7;  // the first block includes captures and errors
        measure(renderer, references, state, stage.part(referenceDone, drawn));
        timeAgain(renderer, references, state, stage.part(drawn, 0.98));
        addExternalRows(views, references, state);
        checkValidation(device_);
        stage.at(0.98, "write");
        tradeoff_.cost.whole = msSince(start_);
        const std::string json =
            writeTradeoff(tradeoff_, folder_, state / "",
                          thumbnail(references.frames.front(), references.exposure), options_.force);
        references_.remove();
        state.remove();
        progress_.wipe();
        noteLeftByOthers(options_, references_);
        if (options_.json) printText(json);
        if (prints()) print(tradeoffEnd(tradeoff_) + (folder_ / "index.html").string() + "\n");
        sayErrors(errors_);
        return errors_.empty() ? 0 : 2;
    }

private:
    bool prints() const { return !options_.json && !options_.quiet; }

    void measure(Renderer& renderer, const ReferenceFrames& references, SweepState& state,
                 const Stage& stage) {
        const TradeoffTable table(tradeoff_, sweep_.rows, terminalColumns(stdout), options_.verbose);
        const std::vector<int> blocks = blockSizes(options_.runs);
        double all = 0, done = 0;
        for (const Settings& row : sweep_.rows) all += weightOf(row);
        if (prints()) print(table.head());
        for (const Settings& settings : sweep_.rows) {
            const double from = done / all;
            done += weightOf(settings);
            std::optional<TradeoffRow> kept = state.find(settings, references.frames.size(), blocks.size());
            if (kept) {
                ++tradeoff_.kept;
                tradeoff_.rows.push_back(std::move(*kept));
            } else {
                RenderOptions render = renderOptions(options_);
                render.runs = blocks.front();
                render.progress = stage.part(from, done / all);
                MeasuredRow measured = measureRow(renderer, settings, references, render);
                tradeoff_.cost.drawing += measured.row.drawing_ms;
                state.keep(measured);
                tradeoff_.rows.push_back(std::move(measured.row));
            }
            if (prints()) print(table.line(tradeoff_, tradeoff_.rows.size() - 1));
        }
    }

    // Adds a row for each external renderer, over all cameras. A failed renderer gets a note instead.
    void addExternalRows(SceneViews& views, const ReferenceFrames& references, SweepState& state) {
        const TradeoffTable table(tradeoff_, sweep_.rows, terminalColumns(stdout), options_.verbose);
        for (const external::Renderer& renderer : options_.renderers) {
            std::vector<Frame> frames;
            std::string problem;
            for (const Frame& reference : references.frames) {
                Settings settings = tradeoff_.given;
                settings.camera = reference.settings.camera;
                external::Attempt attempt = external::drawExternally(
                    renderer, views.scene(), views.at(viewRequest(settings)), settings);
                problem = attempt.problem;
                if (attempt.frame && !attempt.frame->channels.contains(static_cast<int>(gpu::DEBUG_lit)))
                    problem = "its picture has no R, G, B";
                if (!problem.empty()) break;
                for (const std::string& line : attempt.frame->notes)
                    if (std::ranges::count(tradeoff_.notes, line) == 0) tradeoff_.notes.push_back(line);
                frames.push_back(std::move(*attempt.frame));
            }
            if (!problem.empty()) {
                errors_.push_back(
                    {tradeoff_.scene, fmt::format("{}: renderer {} ({}): {}", tradeoff_.scene, renderer.name,
                                                  renderer.file.string(), problem)});
                tradeoff_.notes.push_back("no row: " + errors_.back().message);
                continue;
            }
            MeasuredRow measured = measuredRow(std::move(frames), references);
            state.keep(measured);
            tradeoff_.rows.push_back(std::move(measured.row));
            if (prints()) print(table.line(tradeoff_, tradeoff_.rows.size() - 1));
        }
    }

    // A closed stdout does not stop the sweep: the folder is the result.
    void print(const std::string& line) {
        if (std::ferror(stdout)) return;
        progress_.wipe();
        printText(line);
        std::fflush(stdout);
    }

    // Times the remaining blocks in rounds over all rows, each round in a random order. A temporary
    // disturbance of the device then biases no row. The rows of one batch are interleaved.
    void timeAgain(Renderer& renderer, const ReferenceFrames& references, SweepState& state,
                   const Stage& stage) {
        constexpr std::size_t atOnce = 6;  // rows with allocated images
        const std::vector<int> blocks = blockSizes(options_.runs);
        double all = 0, done = 0;
        for (const TradeoffRow& row : tradeoff_.rows)
            all += weightOf(row.settings) *
                   static_cast<double>(blocks.size() - row.cameras.front().blocks.size());
        std::mt19937 random(1);
        for (std::size_t block = 1; block < blocks.size(); ++block) {
            std::vector<TradeoffRow*> round;
            for (TradeoffRow& row : tradeoff_.rows)
                if (row.cameras.front().blocks.size() == block) round.push_back(&row);
            std::ranges::shuffle(round, random);
            for (std::size_t at = 0; at < round.size(); at += atOnce) {
                const auto rows = std::span(round).subspan(at, std::min(atOnce, round.size() - at));
                RenderOptions render = renderOptions(options_);
                render.runs = blocks[block];
                double before = 0;
                const double from = done / all;
                for (const TradeoffRow* row : rows) {
                    done += weightOf(row->settings);
                    before += row->drawing_ms;
                }
                render.progress = stage.part(from, done / all);
                tradeoff::timeAgain(renderer, rows, references, render);
                for (const TradeoffRow* row : rows) {
                    tradeoff_.cost.drawing += row->drawing_ms;
                    state.renew(*row);
                }
                tradeoff_.cost.drawing -= before;
            }
        }
    }

    const Options& options_;
    SweepRows sweep_;
    const Clock::time_point start_ = Clock::now();
    const std::filesystem::path folder_;
    KeptReferences references_;
    Progress progress_;
    Device device_;
    Tradeoff tradeoff_;
    std::vector<SceneError> errors_;  // from external renderers
};

}  // namespace

int runTradeoff(const Options& words) {
    Options options = words;
    options.scenes = scenesOf(words.scenes);
    checkTradeoffOptions(options);
    const Settings& given = options.settings;
    const SweepRows sweep =
        makeSweepRows(given, options.grid.empty() ? defaultGrids(given) : readGrids(options.grid, given));
    if (options.debug_given) note(options, "--debug is not used: errors are measured in lit");
    if (!options.channels.empty()) note(options, "--channels is not used: errors are measured in lit");
    if (options.scenes.size() == 1 && options.shard.empty()) return Sweep(options, sweep).run();
    return tradeoffMany(options, outputFolder(options, "diptych-tradeoff", "tradeoff", tradeoffsManifest),
                        [&](const Options& one) { Sweep(one, sweep).run(); });
}

}  // namespace diptych::cli
