// SPDX-License-Identifier: MIT
#include "compare/experiment/evaluator.h"

#include "compare/experiment/upsample.h"
#include "compare/reference/key.h"
#include "shared/contract/debug_mode.h"

#include <algorithm>
#include <array>

namespace diptych::experiment {

namespace {

// Prepared Settings kept for timing. Each owns its images.
constexpr std::size_t mostKept = 4;

// The Settings with each camera of the reference frames.
std::vector<Settings> fromEachCamera(const Settings& settings, const ReferenceFrames& references) {
    std::vector<Settings> seen;
    for (const Frame& reference : references.frames) seen.push_back(seenFrom(reference, settings));
    return seen;
}

}  // namespace

bool SceneEvaluator::isOfReferenceSize(const Settings& settings) const {
    return settings.size == references_.frames.front().settings.size;
}

FrameErrors SceneEvaluator::errorsOf(std::size_t camera, const Image& lit) {
    reference::Key key;
    key.addAll(lit.data);
    const std::pair picture(camera, key.value());
    if (const auto known = judged_.find(picture); known != judged_.end()) return known->second;
    FrameErrors errors = references_.errors[camera]->forFigure(figure_, lit);
    if (errors.pixels.empty()) judged_.emplace(picture, errors);
    return errors;
}

Judged SceneEvaluator::judge(const Settings& settings) {
    // An image of another size is upsampled by its channels, which requires a capture.
    if (!isOfReferenceSize(settings)) return judgeCaptured(settings);
    ErrorsOfCameras errors;
    Judged judged;
    const std::vector<Settings> seen = fromEachCamera(settings, references_);
    prepare(seen);
    for (std::size_t camera = 0; camera < cameras(); ++camera) {
        PreparedFrames& frames = drawn(seen[camera]);
        errors.add(errorsOf(camera, frames.lit(0)));
        const FrameBytes& bytes = frames.described(0).bytes;
        judged.bytes = std::max(judged.bytes, bytes.images + bytes.buffers);
    }
    judged.error = errors.errors().at(figure_);
    return judged;
}

Judged SceneEvaluator::judgeCaptured(const Settings& settings) {
    RenderOptions drawing = litOptions(options_, false);
    drawing.runs = 0;
    drawing.progress = {};
    ErrorsOfCameras all;
    Judged judged;
    for (std::size_t camera = 0; camera < cameras(); ++camera) {
        const Frame& reference = references_.frames[camera];
        Frame frame = renderer_.draw(seenFrom(reference, settings), drawing);
        judged.bytes = std::max(judged.bytes, frame.bytes.images + frame.bytes.buffers);
        frame = upsampled(std::move(frame), reference.settings.size);
        const FrameErrors errors =
            (*references_.errors[camera])(frame.channels.at(static_cast<int>(gpu::DEBUG_lit)));
        all.add(errors);
        judged.error = errors.errors.at(figure_);
    }
    if (cameras() > 1) judged.error = all.errors().at(figure_);
    return judged;
}

void SceneEvaluator::prepare(std::span<const Settings> seen) {
    const auto isThere = [&](const Settings& settings) {
        return std::ranges::find(drawn_, settings, &Drawn::settings) != drawn_.end();
    };
    if (std::ranges::all_of(seen, isThere)) return;
    std::size_t others = drawn_.size();
    std::erase_if(drawn_, [&](const Drawn& each) {
        return std::ranges::count(seen, each.settings) == 0 && others-- > mostKept * cameras();
    });
    for (const Settings& settings : seen) {
        if (isThere(settings)) continue;
        const std::size_t pipelines = renderer_.pipelines();
        drawn_.push_back({settings, renderer_.prepare(std::span(&settings, 1)), false});
        drawn_.back().made_pipelines = renderer_.pipelines() > pipelines;
    }
}

SceneEvaluator::Drawn& SceneEvaluator::prepared(const Settings& seen) {
    return *std::ranges::find(drawn_, seen, &Drawn::settings);
}

PreparedFrames& SceneEvaluator::drawn(const Settings& seen) {
    Drawn& each = prepared(seen);
    if (!each.is_drawn) each.frames.draw(0);
    each.is_drawn = true;
    return each.frames;
}

// The first frame may differ from the next: a driver may compile the pipeline, and a clipmap renders pages
// that later frames reuse. Renders it in these cases only.
SceneEvaluator::Drawn& SceneEvaluator::readyForTimes(const Settings& seen) {
    Drawn& each = prepared(seen);
    if (each.made_pipelines || seen.shadows == Shadows::clipmap) drawn(seen);
    each.is_drawn = true;
    return each;
}

std::vector<double> SceneEvaluator::time(std::span<const Settings> frames,
                                         std::span<const std::size_t> order) {
    std::vector<Settings> seen;
    for (const Settings& settings : frames)
        for (Settings& each : fromEachCamera(settings, references_)) seen.push_back(std::move(each));
    prepare(seen);
    for (const Settings& each : seen) readyForTimes(each);
    prepared(seen.front()).frames.warmUp(std::array{std::size_t{0}});
    std::vector<double> times;
    for (const std::size_t i : order) {
        double ms = 0;
        for (std::size_t camera = 0; camera < cameras(); ++camera)
            ms += drawn(seen[i * cameras() + camera]).draw(0);
        times.push_back(ms / static_cast<double>(cameras()));
    }
    return times;
}

std::vector<PassTime> SceneEvaluator::profile(const Settings& settings) {
    const Settings seen = fromEachCamera(settings, references_).front();
    prepare(std::span(&seen, 1));
    PreparedFrames& of = readyForTimes(seen).frames;
    of.warmUp(std::array{std::size_t{0}});
    return of.profile(0);
}

}  // namespace diptych::experiment
