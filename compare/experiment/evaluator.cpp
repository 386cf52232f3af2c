// SPDX-License-Identifier: MIT
#include "compare/experiment/evaluator.h"

#include "compare/experiment/upsample.h"
#include "compare/reference/key.h"
#include "shared/contract/debug_mode.h"

#include <algorithm>
#include <array>

namespace diptych::experiment {

namespace {

// The Settings with each camera of the reference frames.
std::vector<Settings> fromEachCamera(const Settings& settings, const ReferenceFrames& references) {
    std::vector<Settings> seen;
    for (const Frame& reference : references.frames) seen.push_back(seenFrom(reference, settings));
    return seen;
}

}  // namespace

FrameErrors SceneEvaluator::errorsOf(std::size_t camera, const Image& lit) {
    reference::Key key;
    key.addAll(lit.data);
    const std::pair image(camera, key.value());
    if (const auto known = evaluated_.find(image); known != evaluated_.end()) return known->second;
    FrameErrors errors = references_.errors[camera]->forMetric(metricIndex(), lit);
    if (errors.pixels.empty()) evaluated_.emplace(image, errors);
    return errors;
}

Measures SceneEvaluator::evaluate(const Settings& settings) {
    ErrorsOfCameras errors;
    Measures evaluated;
    evaluated[Measure::memory] = 0;
    const auto add = [&](std::size_t camera, const Image& lit, const FrameBytes& bytes) {
        errors.add(errorsOf(camera, lit));
        evaluated[Measure::memory] =
            std::max(evaluated[Measure::memory], static_cast<double>(bytes.images + bytes.buffers));
    };
    RenderOptions drawing = litOptions(options_, false);
    drawing.runs = 0;
    drawing.progress = {};
    const std::vector<Settings> seen = fromEachCamera(settings, references_);
    for (std::size_t camera = 0; camera < cameras(); ++camera) {
        const Size& size = references_.frames[camera].settings.size;
        if (settings.size == size) {
            const Shot& shot = pool_.shot(seen[camera]);
            add(camera, shot.lit, shot.bytes);
        } else {
            // An image of another size is upsampled by its channels, which requires a capture.
            const Frame frame = upsampled(renderer_.draw(seen[camera], drawing), size);
            add(camera, frame.channels.at(Channel::lit), frame.bytes);
        }
    }
    evaluated[metric_] = errors.errors()[metricIndex()];
    return evaluated;
}

// One camera after the other, because their Frames may not fit together.
std::vector<double> SceneEvaluator::time(std::span<const Settings> frames,
                                         std::span<const std::size_t> order) {
    std::vector<double> times(order.size());
    for (const Frame& reference : references_.frames) {
        std::vector<Settings> seen;
        for (const Settings& settings : frames) seen.push_back(seenFrom(reference, settings));
        const std::vector<double> ms = pool_.time(seen, order);
        for (std::size_t i = 0; i < order.size(); ++i) times[i] += ms[i] / static_cast<double>(cameras());
    }
    return times;
}

std::vector<PassTime> SceneEvaluator::profile(const Settings& settings) {
    const Settings seen = fromEachCamera(settings, references_).front();
    PreparedFrames& of = pool_.frame(seen);
    of.warmUp(std::array{std::size_t{0}});
    return of.profile(0);
}

}  // namespace diptych::experiment
