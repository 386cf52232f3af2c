// SPDX-License-Identifier: MIT
#include "compare/tradeoff/measure.h"

#include "compare/experiment/upsample.h"
#include "compare/frames/frame_properties.h"
#include "compare/page/text.h"
#include "compare/render/timing.h"
#include "compare/run/progress.h"
#include "compare/tradeoff/captured_errors.h"
#include "compare/verdict/pair_reports.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

namespace diptych::tradeoff {

using page::cameraTitle;

namespace {

constexpr int widestThumbnail = 480;  // pixels; width of a card on the page

using Clock = std::chrono::steady_clock;

// The first timing block from one camera.
experiment::Row timed(experiment::PreparedPool& pool, const Settings& seen, int runs) {
    experiment::Row camera;
    std::vector<std::vector<PassTime>> passes;
    const std::vector<std::size_t> order(static_cast<std::size_t>(runs), 0);
    camera.blocks = {diptych::timeOf(pool.time(std::span(&seen, 1), order))};
    PreparedFrames& frames = pool.frame(seen);
    for (int i = 0; i < profiledOf(runs); ++i) passes.push_back(frames.profile(0));
    camera.passes = mediansOf(passes);
    camera.measured.set(frames.described(0).bytes);
    joinBlocks(camera);
    return camera;
}

// Adds what a capture shows: errors of shadows and of the choice of samples, compared with --msaa-edges
// exact; and the material of each pixel, which an image of another size is enlarged by.
void addCaptured(Renderer& renderer, const Frame& reference, const RenderOptions& options, Frame& frame,
                 experiment::Row& camera) {
    const bool shadows = !reference.shadow_edge.empty();
    const std::optional<Settings> exact = exactEdges(frame.settings);
    if (!shadows && !exact && frame.settings.size == reference.settings.size) {
        frame.channels[Channel::material_id] = reference.channels.at(Channel::material_id);
        return;
    }
    RenderOptions drawing = experiment::litOptions(options, shadows);
    drawing.runs = 0;
    if (exact) drawing.channels.push_back(Channel::shaded_samples);
    drawing.requested = drawing.channels;
    frame = renderer.draw(frame.settings, drawing);
    if (const auto errors = shadowErrorsOf(reference, frame))
        camera.measured.set(Measure::shadow_error, *errors);
    if (!exact) return;
    drawing.on_step = {};
    drawing.progress = {};
    if (const auto fractions =
            sampleFractionsOf(*exact == frame.settings ? frame : renderer.draw(*exact, drawing), frame))
        camera.measured.set(Measure::shaded, *fractions);
}

Image8 small(Image8 image) {
    while (image.width > widestThumbnail) image = halfSize(image);
    return image;
}

void warn(TradeoffRow& row, const Frame& frame) {
    const auto add = [&](std::uint64_t count, const char* noun, const char* what) {
        if (count > 0)
            row.warnings.push_back(fmt::format("{}: {} {}", cameraTitle(frame), counted(count, noun), what));
    };
    add(frame.counters.nonfinite_pixels, "pixel", "of lit with NaN or infinity");
    add(frame.counters.overflowed_lists, "light list", "overflowed: every light was evaluated there");
    add(frame.counters.shadow_pages.fallback, "shadow page", "did not fit: a coarser level was used there");
    add(frame.counters.unsorted.fragments, "blended fragment", "overflowed the list: blended as one layer");
}

// Adds a camera with the errors of `frame`, which has the reference's size. The first one's images show
// the row; after the last one, the row's errors are those of `all`.
void addCamera(MeasuredRow& measured, experiment::Row camera, const Frame& frame,
               const experiment::ReferenceFrames& references, experiment::ErrorsOfCameras& all) {
    const std::size_t i = measured.row.cameras.size();
    const experiment::FrameErrors errors = (*references.errors[i])(frame.channels.at(Channel::lit));
    camera.measured.set(Measure::flip, errors.errors);
    camera.measured[Measure::compared_pixels] = static_cast<double>(errors.pixels.size());
    measured.row.cameras.push_back(std::move(camera));
    all.add(errors);
    if (i + 1 == references.frames.size()) {
        joinCameras(measured.row);
        measured.row.measured.set(Measure::flip, i == 0 ? errors.errors : all.errors());
    }
    if (i > 0) return;
    measured.image = thumbnail(frame, references.exposure);
    measured.errors = small(errorMap(errors.flip, 1));
}

}  // namespace

Image8 thumbnail(const Frame& frame, const Exposure& exposure) {
    const Frame* frames[] = {&frame};
    return small(
        channelImage(debugMode(Channel::lit), frame, scaleFor(debugMode(Channel::lit), exposure, frames)));
}

MeasuredRow measuredRow(std::vector<Frame> frames, const experiment::ReferenceFrames& references) {
    MeasuredRow measured;
    TradeoffRow& row = measured.row;
    row.settings = frames.front().settings;
    row.renderer = frames.front().name;
    row.renderer_file = frames.front().origin.file;
    experiment::ErrorsOfCameras all;
    for (std::size_t i = 0; i < references.frames.size(); ++i) {
        Frame& frame = frames.at(i);
        showOurBackground(frame, references.frames[i]);
        const double ms = frame.made_in_ms;
        row.drawing_ms += ms;
        experiment::Row camera{.camera = cameraTitle(frame), .blocks = {{ms, ms, ms, 1}}};
        joinBlocks(camera);
        addCamera(measured, std::move(camera), frame, references, all);
    }
    row.warnings.push_back(
        "its time is its whole command's, from start to end: it is left out of the fronts");
    return measured;
}

MeasuredRow measureRow(Renderer& renderer, experiment::PreparedPool& pool, const Settings& settings,
                       const experiment::ReferenceFrames& references, const RenderOptions& options) {
    MeasuredRow measured;
    TradeoffRow& row = measured.row;
    row.settings = experiment::seenFrom(references.frames.front(), settings);
    experiment::ErrorsOfCameras all;
    for (std::size_t i = 0; i < references.frames.size(); ++i) {
        const Frame& reference = references.frames[i];
        const double from = static_cast<double>(i), count = static_cast<double>(references.frames.size());
        const Stage progress = options.progress.part(from / count, (from + 1) / count);
        const Settings seen = experiment::seenFrom(reference, settings);
        const auto start = Clock::now();
        progress.at(0, fmt::format("{}: time", nameOf(seen.path)));
        if (options.on_step) options.on_step(fmt::format("{}: time", nameOf(seen.path)));
        experiment::Row camera = timed(pool, seen, options.runs);
        Frame frame = pool.frame(seen).frame(0);
        camera.camera = cameraTitle(frame);
        camera.measured.set(frame.counters);
        warn(row, frame);
        RenderOptions captured = options;
        captured.progress = progress.part(0.5, 1);
        addCaptured(renderer, reference, captured, frame, camera);
        row.drawing_ms += msSince(start);
        if (camera[Measure::elsewhere] > 0)
            row.warnings.push_back(
                cameraTitle(frame) +
                ": pixels differ from --msaa-edges exact although as many samples are shaded");
        frame = experiment::upsampled(std::move(frame), reference.settings.size);
        addCamera(measured, std::move(camera), frame, references, all);
    }
    return measured;
}

void timeAgain(experiment::PreparedPool& pool, std::span<TradeoffRow* const> rows,
               const experiment::ReferenceFrames& references, int runs, const Stage& progress) {
    std::vector<std::size_t> order;
    for (int run = 0; run < runs; ++run)
        for (std::size_t i = 0; i < rows.size(); ++i) order.push_back(i);
    for (std::size_t camera = 0; camera < references.frames.size(); ++camera) {
        progress.at(static_cast<double>(camera) / static_cast<double>(references.frames.size()),
                    "time again");
        std::vector<Settings> seen;
        for (const TradeoffRow* row : rows)
            seen.push_back(experiment::seenFrom(references.frames[camera], row->settings));
        const auto start = Clock::now();
        const std::vector<double> times = pool.time(seen, order);
        const double took = msSince(start) / static_cast<double>(rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            std::vector<double> ms;
            for (std::size_t at = i; at < times.size(); at += rows.size()) ms.push_back(times[at]);
            rows[i]->drawing_ms += took;
            experiment::Row& of = rows[i]->cameras[camera];
            of.blocks.push_back(diptych::timeOf(std::move(ms)));
            joinBlocks(of);
        }
    }
    for (TradeoffRow* row : rows) joinCameras(*row);
}

}  // namespace diptych::tradeoff
