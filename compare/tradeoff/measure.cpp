// SPDX-License-Identifier: MIT
#include "compare/tradeoff/measure.h"

#include "compare/page/text.h"
#include "compare/render/left_out.h"
#include "compare/tradeoff/sample_figures.h"
#include "compare/tradeoff/upsample.h"
#include "compare/verdict/pair_reports.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::tradeoff {

using page::cameraTitle;

namespace {

constexpr auto LIT = static_cast<int>(gpu::DEBUG_lit), IDS = static_cast<int>(gpu::DEBUG_material_id);
// Channels that evaluate shadows.
constexpr auto SEEN = static_cast<int>(gpu::DEBUG_shadow_visibility),
               DEPTH = static_cast<int>(gpu::DEBUG_depth), LEVEL = static_cast<int>(gpu::DEBUG_cascade),
               COARSER = static_cast<int>(gpu::DEBUG_page_residency);
constexpr auto SHADED = static_cast<int>(gpu::DEBUG_shaded_samples);
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int widestThumbnail = 480;  // pixels; width of a card on the page

double knownOrInfinite(double value) {
    return std::isfinite(value) ? value : infinity;
}

// Renders lit, and material_id to detect the background. `shadows`: also channels that evaluate shadows.
RenderOptions drawingOptions(const RenderOptions& options, bool shadows) {
    RenderOptions drawing = options;
    drawing.channels = {LIT, IDS};
    if (shadows) drawing.channels.insert(drawing.channels.end(), {SEEN, DEPTH, LEVEL, COARSER});
    drawing.requested = drawing.channels;
    drawing.twice = Twice::none;
    drawing.through_gbuffer = false;
    return drawing;
}

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
    add(frame.counters.unreproduced_pixels, "pixel",
        "of the captured channels did not match the timed pipeline");
}

}  // namespace

ReferenceFrames drawReferenceFrames(Renderer& renderer, const Settings& given,
                                    const std::vector<std::string>& cameras, const PictureChoice& choice,
                                    const RenderOptions& options, bool shadows) {
    RenderOptions drawing = drawingOptions(options, shadows && given.shadows != Shadows::off);
    drawing.runs = 0;
    drawing.shadow_edges = shadows;
    ReferenceFrames references;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const double from = static_cast<double>(i), all = static_cast<double>(cameras.size());
        drawing.progress = options.progress.part(from / all, (from + 1) / all);
        Settings settings = referenceSettings(given);
        settings.camera = cameras[i];
        references.frames.push_back(renderer.draw(settings, drawing));
        references.errors.push_back(std::make_shared<ErrorsAgainst>(references.frames.back()));
    }
    const Frame& first = references.frames.front();
    references.exposure = exposureFor(choice, &first.channels.at(LIT), coverage(first, first));
    return references;
}

RelativeErrors relativeErrors(std::vector<double> errors) {
    if (errors.empty()) return {};
    double squares = 0;
    for (const double e : errors) squares += e * e;
    const auto count = static_cast<double>(errors.size());
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.99 * count));
    const auto nth = errors.begin() + std::max<std::ptrdiff_t>(rank, 1) - 1;
    std::nth_element(errors.begin(), nth, errors.end());
    return {knownOrInfinite(std::sqrt(squares / count)), knownOrInfinite(*nth)};
}

namespace {

HdrFlipOptions flipOver(const Coverage& coverage) {
    HdrFlipOptions options;
    options.covered = coverage.covered;
    return options;
}

}  // namespace

ErrorsAgainst::ErrorsAgainst(const Frame& reference)
    : coverage_(coverage(reference, reference)),  // the same pixels for all rows
      reference_(reference.channels.at(LIT)),
      covered_(covered(reference_)),
      relative_(debugMode(LIT).metric, debugMode(LIT).kind, reference_, coverage_) {}

const HdrFlipAgainst& ErrorsAgainst::flip() const {
    if (!flip_) flip_.emplace(covered_, flipOver(coverage_));
    return *flip_;
}

Image ErrorsAgainst::covered(const Image& lit) const {
    Image image = lit;
    for (std::size_t i = 0; i < image.pixels(); ++i)
        if (!coverage_.covered[i])
            std::fill_n(image.pixel(i), image.components, std::numeric_limits<float>::quiet_NaN());
    return image;
}

std::vector<double> ErrorsAgainst::pixelsOf(const Image& lit) const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < reference_.pixels(); ++i)
        if (coverage_.covered[i]) errors.push_back(relative_(lit.pixel(i), reference_.pixel(i)));
    return errors;
}

FrameErrors ErrorsAgainst::operator()(const Image& lit) const {
    FrameErrors result;
    result.pixels = pixelsOf(lit);
    HdrFlipResult seen = flip()(covered(lit));
    result.flip = std::move(seen.error);
    result.flip_pixels = seen.pixels;
    result.flip_sum = seen.mean * static_cast<double>(seen.pixels);
    const RelativeErrors relative = relativeErrors(result.pixels);
    result.errors = {knownOrInfinite(seen.mean), relative.rmse, relative.p99};
    return result;
}

FrameErrors ErrorsAgainst::forFigure(std::size_t figure, const Image& lit) const {
    FrameErrors result;
    constexpr std::size_t flipFigure = 0;  // other metrics use the pixels' relative errors
    if (figure != flipFigure) {
        result.pixels = pixelsOf(lit);
        return result;
    }
    const HdrFlipAgainst::Mean seen = flip().mean(covered(lit));
    result.flip_pixels = seen.pixels;
    result.flip_sum = seen.mean * static_cast<double>(seen.pixels);
    return result;
}

void addNotes(std::vector<std::string>& notes, const ReferenceFrames& references,
              std::span<const Settings> rows, const Requirements& needs) {
    const auto add = [&](const std::vector<std::string>& lines) {
        for (const std::string& line : lines)
            if (std::ranges::count(notes, line) == 0) notes.push_back(line);
    };
    for (const Frame& frame : references.frames) add(frame.notes);
    for (const Path path : drawn_paths)
        if (std::ranges::count(rows, path, &Settings::path) > 0) add(leftOutLight(path, needs));
}

void ErrorsOfCameras::add(const FrameErrors& camera) {
    pixels_.insert(pixels_.end(), camera.pixels.begin(), camera.pixels.end());
    flip_sum_ += camera.flip_sum;
    flip_pixels_ += static_cast<double>(camera.flip_pixels);
}

Errors ErrorsOfCameras::errors() const {
    const RelativeErrors relative = relativeErrors(pixels_);
    return {flip_pixels_ > 0 ? knownOrInfinite(flip_sum_ / flip_pixels_) : 0, relative.rmse, relative.p99};
}

Image8 thumbnail(const Frame& frame, const Exposure& exposure) {
    const Frame* frames[] = {&frame};
    return small(channelPicture(debugMode(LIT), frame, scaleFor(debugMode(LIT), exposure, frames)));
}

MeasuredRow measuredRow(std::vector<Frame> frames, const ReferenceFrames& references) {
    MeasuredRow measured;
    TradeoffRow& row = measured.row;
    row.settings = frames.front().settings;
    row.renderer = frames.front().name;
    row.renderer_file = frames.front().origin.file;
    ErrorsOfCameras all_errors;
    for (std::size_t i = 0; i < references.frames.size(); ++i) {
        Frame& frame = frames.at(i);
        showOurBackground(frame, references.frames[i]);
        row.drawing_ms += frame.made_in_ms;
        const FrameErrors errors = (*references.errors[i])(frame.channels.at(LIT));
        CameraRow camera{cameraTitle(frame),
                         {{frame.made_in_ms, frame.made_in_ms, frame.made_in_ms, 1}},
                         {},
                         {},
                         errors.errors,
                         errors.pixels.size()};
        row.cameras.push_back(std::move(camera));
        all_errors.add(errors);
        if (i > 0) continue;
        measured.picture = thumbnail(frame, references.exposure);
        measured.errors = small(errorPicture(errors.flip, 1));
    }
    row.errors = references.frames.size() == 1 ? row.cameras.front().errors : all_errors.errors();
    row.warnings.push_back(
        "its time is its whole command's, from start to end: it is left out of the fronts");
    return measured;
}

MeasuredRow measureRow(Renderer& renderer, const Settings& settings, const ReferenceFrames& references,
                       const RenderOptions& options) {
    const bool shadows = !references.frames.front().shadow_edge.empty();
    RenderOptions drawing = drawingOptions(options, shadows);
    MeasuredRow measured;
    TradeoffRow& row = measured.row;
    row.settings = settings;
    row.settings.camera = references.frames.front().settings.camera;
    ErrorsOfCameras all_errors;
    for (std::size_t i = 0; i < references.frames.size(); ++i) {
        const Frame& reference = references.frames[i];
        const double from = static_cast<double>(i), all = static_cast<double>(references.frames.size());
        drawing.progress = options.progress.part(from / all, (from + 1) / all);
        Settings seen = settings;
        seen.camera = reference.settings.camera;
        RenderOptions with_samples = drawing;
        if (exactEdges(seen)) with_samples.channels.push_back(SHADED);
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
        frame = upsampled(std::move(frame), reference.settings.size);
        const FrameErrors errors = (*references.errors[i])(frame.channels.at(LIT));
        camera.errors = errors.errors;
        camera.pixels = errors.pixels.size();
        row.cameras.push_back(std::move(camera));
        all_errors.add(errors);
        if (i > 0) continue;
        measured.picture = thumbnail(frame, references.exposure);
        measured.errors = small(errorPicture(errors.flip, 1));
    }
    row.errors = all_errors.errors();
    if (references.frames.size() == 1) row.errors = row.cameras.front().errors;
    return measured;
}

void timeAgain(Renderer& renderer, std::span<TradeoffRow* const> rows, const ReferenceFrames& references,
               const RenderOptions& options) {
    RenderOptions timing = options;
    for (std::size_t camera = 0; camera < references.frames.size(); ++camera) {
        const double from = static_cast<double>(camera), all = static_cast<double>(references.frames.size());
        timing.progress = options.progress.part(from / all, (from + 1) / all);
        std::vector<Settings> seen;
        for (const TradeoffRow* row : rows) {
            seen.push_back(row->settings);
            seen.back().camera = references.frames[camera].settings.camera;
        }
        const std::vector<TimedFrame> times = renderer.time(seen, timing);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i]->drawing_ms += times[i].made_in_ms;
            rows[i]->cameras[camera].blocks.push_back(times[i].time);
        }
    }
}

}  // namespace diptych::tradeoff
