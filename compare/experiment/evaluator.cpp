// SPDX-License-Identifier: MIT
#include "compare/experiment/evaluator.h"

#include "compare/experiment/upsample.h"
#include "compare/reference/key.h"
#include "shared/contract/debug_mode.h"

#include <malloc.h>

#include <algorithm>
#include <array>

namespace diptych::experiment {

namespace {

// Bytes of prepared Frames kept for timing: some four at 640x360. The others are prepared again; as Frames
// are timed in an order and its reverse, most are found.
constexpr std::uint64_t mostKept = std::uint64_t{352} << 20;
// Bytes of freed host memory that are kept for the next pipelines (compare/render/MEASURED.md).
constexpr std::size_t mostFreed = std::size_t{128} << 20;

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
    const std::pair picture(camera, key.value());
    if (const auto known = judged_.find(picture); known != judged_.end()) return known->second;
    FrameErrors errors = references_.errors[camera]->forFigure(figure_, lit);
    if (errors.pixels.empty()) judged_.emplace(picture, errors);
    return errors;
}

Judged SceneEvaluator::judge(const Settings& settings) {
    ErrorsOfCameras errors;
    Judged judged;
    const auto add = [&](std::size_t camera, const Image& lit, const FrameBytes& bytes) {
        errors.add(errorsOf(camera, lit));
        judged.bytes = std::max(judged.bytes, bytes.images + bytes.buffers);
    };
    RenderOptions drawing = litOptions(options_, false);
    drawing.runs = 0;
    drawing.progress = {};
    const std::vector<Settings> seen = fromEachCamera(settings, references_);
    for (std::size_t camera = 0; camera < cameras(); ++camera) {
        const Size& size = references_.frames[camera].settings.size;
        if (settings.size == size) {
            PreparedFrames& frames = drawn(seen[camera]);
            add(camera, frames.lit(0), frames.described(0).bytes);
        } else {
            // An image of another size is upsampled by its channels, which requires a capture.
            const Frame frame = upsampled(renderer_.draw(seen[camera], drawing), size);
            add(camera, frame.channels.at(Channel::lit), frame.bytes);
        }
    }
    judged.error = errors.errors().at(figure_);
    return judged;
}

PreparedFrames& SceneEvaluator::drawn(const Settings& seen) {
    const auto found = std::ranges::find(drawn_, seen, &Drawn::settings);
    if (found != drawn_.end()) {
        drawn_.splice(drawn_.end(), drawn_, found);
        return drawn_.back().frames;
    }
    // Expects it to be as large as the one before.
    keep(mostKept - std::min(mostKept, drawn_.empty() ? 0 : drawn_.back().bytes));
    PreparedFrames frames = renderer_.prepare(std::span(&seen, 1));
    const FrameBytes& bytes = frames.described(0).bytes;
    drawn_.push_back({seen, std::move(frames), bytes.images + bytes.buffers});
    keep(mostKept);
    drawn_.back().frames.draw(0);
    if (mallinfo2().fordblks > mostFreed) malloc_trim(0);
    return drawn_.back().frames;
}

void SceneEvaluator::keep(std::uint64_t most) {
    std::uint64_t kept = 0;
    for (const Drawn& each : drawn_) kept += each.bytes;
    for (; drawn_.size() > 1 && kept > most; drawn_.pop_front()) kept -= drawn_.front().bytes;
}

// One camera after the other, because their Frames may not fit together.
std::vector<double> SceneEvaluator::time(std::span<const Settings> frames,
                                         std::span<const std::size_t> order) {
    std::vector<double> times(order.size());
    for (const Frame& reference : references_.frames) {
        std::vector<Settings> seen;
        for (const Settings& settings : frames) seen.push_back(seenFrom(reference, settings));
        for (const Settings& each : seen) drawn(each);
        drawn(seen.front()).warmUp(std::array{std::size_t{0}});
        for (std::size_t i = 0; i < order.size(); ++i)
            times[i] += drawn(seen[order[i]]).draw(0) / static_cast<double>(cameras());
    }
    return times;
}

std::vector<PassTime> SceneEvaluator::profile(const Settings& settings) {
    const Settings seen = fromEachCamera(settings, references_).front();
    PreparedFrames& of = drawn(seen);
    of.warmUp(std::array{std::size_t{0}});
    return of.profile(0);
}

}  // namespace diptych::experiment
