// SPDX-License-Identifier: MIT
#include "compare/tradeoff/sweep.h"

#include "compare/experiment/row_checkpoint.h"
#include "compare/experiment/sensitivity.h"
#include "compare/external/external_frame.h"
#include "compare/frames/frame_properties.h"
#include "compare/render/load_scene.h"
#include "compare/tradeoff/measure.h"
#include "shared/contract/debug_mode.h"
#include "shared/draw/depth_storage.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <random>
#include <span>
#include <utility>

namespace diptych::tradeoff {

namespace {

// Relative cost of a row, pixels, for the progress line.
double weightOf(const Settings& settings) {
    return static_cast<double>(settings.size.width) * settings.size.height;
}

// Timed frames in each timing block of a row. The first block runs when the row is rendered, the others
// after all rows.
std::vector<int> blockSizes(int runs) {
    constexpr int max = 5;  // each block allocates the row's images again
    const int at_once = std::max(4, (runs + max - 1) / max);
    std::vector<int> blocks{std::min((runs + 1) / 2, at_once)};
    for (int rest = runs - blocks.front(); rest > 0; rest -= blocks.back())
        blocks.push_back(std::min(rest, at_once));
    return blocks;
}

// Without the rows that the device cannot draw.
SweepQuestion drawable(SweepQuestion question, const Device& device) {
    question.rows =
        experiment::withoutRefused(std::move(question.rows), question.settings,
                                   [&](const Settings& row) { return drawingProblem(device, row); });
    return question;
}

Tradeoff begun(const SweepQuestion& question, const Device& device) {
    Tradeoff tradeoff;
    tradeoff.scene = question.scene;
    tradeoff.cameras = question.cameras;
    tradeoff.requested = experiment::referenceFor(question.settings, question.rows.rows);
    tradeoff.reference = referenceSettings(tradeoff.requested);
    tradeoff.device = reportDevice(device);
    tradeoff.runs = question.drawing.runs;
    return tradeoff;
}

}  // namespace

Sweep::Sweep(SweepQuestion question, Device& device, const Stage& stage)
    : question_(drawable(std::move(question), device)),
      device_(device),
      stage_(stage),
      tradeoff_(begun(question_, device)),
      loaded_(loadingFraction(question_.scene, question_.drawing, rows().size() * question_.cameras.size())),
      scene_(loadSceneWithSettings(question_.scene, question_.settings, stage.part(0, loaded_))),
      views_(scene_),
      renderer_(device, sensitiveViews()),
      pool_(renderer_),
      reference_checkpoints_(question_.folder, true),
      references_(drawReferences()),
      state_(question_.folder, key()) {}

SceneViews& Sweep::sensitiveViews() {
    tradeoff_.notes = scene_.notes;
    stage_.at(loaded_, "upload");
    if (question_.only_sensitive)
        question_.rows = experiment::sensitiveRows(
            question_.rows, views_.at(viewRequest(question_.settings)).lights, &views_.scene());
    tradeoff_.skips = question_.rows.skips;
    return views_;
}

double Sweep::referenced() const {
    return loaded_ + (1 - loaded_) / static_cast<double>(rows().size() + 1);
}

experiment::ReferenceFrames Sweep::drawReferences() {
    tradeoff_.cost.reading = msSince(question_.start);
    const auto uploaded = std::chrono::steady_clock::now();
    RenderOptions drawing = question_.drawing;
    drawing.progress = stage_.part(loaded_, referenced()).about(tradeoff_.scene + ": reference");
    drawing.keep = reference_checkpoints_.opener();
    experiment::ReferenceFrames references = experiment::drawReferenceFrames(
        renderer_, tradeoff_.requested, question_.cameras, question_.image, drawing);
    tradeoff_.cost.reference = msSince(uploaded);
    experiment::addNotes(tradeoff_.notes, references, rows(),
                         views_.at(viewRequest(question_.settings)).needs);
    return references;
}

// Inputs of a row besides its Settings.
nlohmann::ordered_json Sweep::key() const {
    std::vector<const Frame*> frames;
    for (const Frame& frame : references_.frames) frames.push_back(&frame);
    nlohmann::ordered_json key = experiment::keyOf(tradeoff_.scene, experiment::fingerprint(frames),
                                                   tradeoff_.reference, tradeoff_.device);
    key["cameras"] = question_.cameras;
    key["exposure"] = references_.exposure.factor;
    key["tonemap"] = references_.exposure.tonemap;
    key["runs"] = question_.drawing.runs;
    return key;
}

void Sweep::draw(const std::function<void(std::size_t)>& shown) {
    // The first block includes captures and errors.
    const double drawn = referenced() + (0.98 - referenced()) * 0.7;
    drawRows(stage_.part(referenced(), drawn), shown);
    timeAgain(stage_.part(drawn, 0.98));
}

void Sweep::drawRows(const Stage& stage, const std::function<void(std::size_t)>& shown) {
    const std::vector<int> blocks = blockSizes(tradeoff_.runs);
    double all = 0, done = 0;
    for (const Settings& row : rows()) all += weightOf(row);
    for (const Settings& settings : rows()) {
        const double from = done / all;
        done += weightOf(settings);
        if (std::optional<TradeoffRow> kept =
                state_.find(settings, references_.frames.size(), blocks.size())) {
            ++tradeoff_.resumed_rows;
            tradeoff_.rows.push_back(std::move(*kept));
        } else {
            RenderOptions render = question_.drawing;
            render.runs = blocks.front();
            render.progress = stage.part(from, done / all);
            MeasuredRow measured = measureRow(renderer_, pool_, settings, references_, render);
            measured.row.scene = tradeoff_.scene;
            tradeoff_.cost.drawing += measured.row.drawing_ms;
            state_.keep(measured);
            tradeoff_.rows.push_back(std::move(measured.row));
        }
        shown(tradeoff_.rows.size() - 1);
    }
}

// Times the remaining blocks in rounds over all rows, each round in a random order. A temporary disturbance
// of the device then biases no row. Rows whose images fit into the pool together are interleaved.
void Sweep::timeAgain(const Stage& stage) {
    const std::vector<int> blocks = blockSizes(tradeoff_.runs);
    double all = 0, done = 0;
    for (const TradeoffRow& row : tradeoff_.rows)
        all +=
            weightOf(row.settings) * static_cast<double>(blocks.size() - row.cameras.front().blocks.size());
    std::mt19937 random(1);
    for (std::size_t block = 1; block < blocks.size(); ++block) {
        std::vector<TradeoffRow*> round;
        for (TradeoffRow& row : tradeoff_.rows)
            if (row.cameras.front().blocks.size() == block) round.push_back(&row);
        std::ranges::shuffle(round, random);
        for (std::size_t at = 0, count = 0; at < round.size(); at += count) {
            std::uint64_t bytes = 0;
            const double from = done / all;
            double before = 0;
            for (count = 0; at + count < round.size(); ++count) {
                const TradeoffRow& row = *round[at + count];
                bytes += static_cast<std::uint64_t>(row[Measure::memory]);
                if (count > 0 && bytes > experiment::PreparedPool::maxBytes) break;
                done += weightOf(row.settings);
                before += row.drawing_ms;
            }
            const auto rows = std::span(round).subspan(at, count);
            tradeoff::timeAgain(pool_, rows, references_, blocks[block], stage.part(from, done / all));
            for (const TradeoffRow* row : rows) {
                tradeoff_.cost.drawing += row->drawing_ms;
                state_.renew(*row);
            }
            tradeoff_.cost.drawing -= before;
        }
    }
}

std::vector<SceneError> Sweep::drawExternally(std::span<const external::ExternalRenderer> renderers,
                                              const std::function<void(std::size_t)>& shown) {
    std::vector<SceneError> errors;
    for (const external::ExternalRenderer& renderer : renderers) {
        std::vector<Frame> frames;
        std::string problem;
        for (const Frame& reference : references_.frames) {
            const Settings settings = experiment::seenFrom(reference, tradeoff_.requested);
            external::Attempt attempt =
                external::drawExternally(renderer, scene_, views_.at(viewRequest(settings)), settings);
            problem = attempt.problem;
            if (attempt.frame && !attempt.frame->channels.contains(Channel::lit))
                problem = "its picture has no R, G, B";
            if (!problem.empty()) break;
            for (const std::string& line : attempt.frame->notes)
                if (std::ranges::count(tradeoff_.notes, line) == 0) tradeoff_.notes.push_back(line);
            frames.push_back(std::move(*attempt.frame));
        }
        if (!problem.empty()) {
            errors.push_back({tradeoff_.scene, fmt::format("{}: renderer {} ({}): {}", tradeoff_.scene,
                                                           renderer.name, renderer.file.string(), problem)});
            tradeoff_.notes.push_back("no row: " + errors.back().message);
            continue;
        }
        MeasuredRow measured = measuredRow(std::move(frames), references_);
        measured.row.scene = tradeoff_.scene;
        state_.keep(measured);
        tradeoff_.rows.push_back(std::move(measured.row));
        shown(tradeoff_.rows.size() - 1);
    }
    return errors;
}

std::string Sweep::write(bool force) {
    stage_.at(0.98, "write");
    tradeoff_.cost.whole = msSince(question_.start);
    std::string json = writeTradeoff(tradeoff_, question_.folder, state_ / "",
                                     thumbnail(references_.frames.front(), references_.exposure), force);
    reference_checkpoints_.remove();
    state_.remove();
    return json;
}

}  // namespace diptych::tradeoff
