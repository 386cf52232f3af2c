// SPDX-License-Identifier: MIT
#include "compare/tradeoff/measure.h"

#include "compare/experiment/upsample.h"
#include "compare/page/text.h"
#include "compare/tradeoff/sample_figures.h"
#include "compare/verdict/pair_reports.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <utility>

namespace diptych::tradeoff {

using page::cameraTitle;

namespace {

constexpr int widestThumbnail = 480;  // pixels; width of a card on the page

// Compares the row with --msaa-edges exact; empty without a choice of samples. `options`: used to render
// `frame`.
std::optional<SampleShares> choiceOfSamples(Renderer& renderer, const Frame& frame, RenderOptions options) {
    const std::optional<Settings> exact = exactEdges(frame.settings);
    if (!exact) return {};
    if (*exact == frame.settings) return sampleSharesOf(frame, frame);
    options.runs = 0;
    options.progress = {};
    options.on_step = {};
    return sampleSharesOf(renderer.draw(*exact, options), frame);
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

// Adds a camera with the errors of `frame`, which has the reference's size. The first one's pictures show
// the row; after the last one, the row's errors are those of `all`.
void addCamera(MeasuredRow& measured, CameraRow camera, const Frame& frame,
               const experiment::ReferenceFrames& references, experiment::ErrorsOfCameras& all) {
    const std::size_t i = measured.row.cameras.size();
    const experiment::FrameErrors errors = (*references.errors[i])(frame.channels.at(Channel::lit));
    camera.errors = errors.errors;
    camera.pixels = errors.pixels.size();
    measured.row.cameras.push_back(std::move(camera));
    all.add(errors);
    if (i + 1 == references.frames.size()) measured.row.errors = i == 0 ? errors.errors : all.errors();
    if (i > 0) return;
    measured.picture = thumbnail(frame, references.exposure);
    measured.errors = small(errorPicture(errors.flip, 1));
}

}  // namespace

Image8 thumbnail(const Frame& frame, const Exposure& exposure) {
    const Frame* frames[] = {&frame};
    return small(
        channelPicture(debugMode(Channel::lit), frame, scaleFor(debugMode(Channel::lit), exposure, frames)));
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
        addCamera(measured, {cameraTitle(frame), {{ms, ms, ms, 1}}, {}, {}}, frame, references, all);
    }
    row.warnings.push_back(
        "its time is its whole command's, from start to end: it is left out of the fronts");
    return measured;
}

MeasuredRow measureRow(Renderer& renderer, const Settings& settings,
                       const experiment::ReferenceFrames& references, const RenderOptions& options) {
    const bool shadows = !references.frames.front().shadow_edge.empty();
    RenderOptions drawing = experiment::litOptions(options, shadows);
    MeasuredRow measured;
    TradeoffRow& row = measured.row;
    row.settings = experiment::seenFrom(references.frames.front(), settings);
    experiment::ErrorsOfCameras all;
    for (std::size_t i = 0; i < references.frames.size(); ++i) {
        const Frame& reference = references.frames[i];
        const double from = static_cast<double>(i), count = static_cast<double>(references.frames.size());
        drawing.progress = options.progress.part(from / count, (from + 1) / count);
        const Settings seen = experiment::seenFrom(reference, settings);
        RenderOptions with_samples = drawing;
        if (exactEdges(seen)) with_samples.channels.push_back(Channel::shaded_samples);
        with_samples.requested = with_samples.channels;
        Frame frame = renderer.draw(seen, with_samples);
        row.drawing_ms += frame.made_in_ms;
        warn(row, frame);
        CameraRow camera{cameraTitle(frame),
                         {frame.time},
                         frame.passes,
                         frame.bytes,
                         {},
                         0,
                         shadowErrorsOf(reference, frame),
                         choiceOfSamples(renderer, frame, with_samples)};
        if (camera.samples && camera.samples->back() > 0)
            row.warnings.push_back(
                cameraTitle(frame) +
                ": pixels differ from --msaa-edges exact although as many samples are shaded");
        frame = experiment::upsampled(std::move(frame), reference.settings.size);
        addCamera(measured, std::move(camera), frame, references, all);
    }
    return measured;
}

void timeAgain(Renderer& renderer, std::span<TradeoffRow* const> rows,
               const experiment::ReferenceFrames& references, const RenderOptions& options) {
    RenderOptions timing = options;
    for (std::size_t camera = 0; camera < references.frames.size(); ++camera) {
        const double from = static_cast<double>(camera), all = static_cast<double>(references.frames.size());
        timing.progress = options.progress.part(from / all, (from + 1) / all);
        std::vector<Settings> seen;
        for (const TradeoffRow* row : rows)
            seen.push_back(experiment::seenFrom(references.frames[camera], row->settings));
        const std::vector<TimedFrame> times = renderer.time(seen, timing);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i]->drawing_ms += times[i].made_in_ms;
            rows[i]->cameras[camera].blocks.push_back(times[i].time);
        }
    }
}

}  // namespace diptych::tradeoff
