// SPDX-License-Identifier: MIT
#include "compare/cli/scene_lab.h"

#include "shared/contract/debug_mode.h"

#include <algorithm>
#include <array>

namespace diptych::cli {

namespace {

constexpr auto LIT = static_cast<int>(gpu::DEBUG_lit);

// The Settings from each camera of the reference frames.
std::vector<Settings> fromEachCamera(const Settings& settings, const tradeoff::ReferenceFrames& references) {
    std::vector<Settings> seen;
    for (const Frame& reference : references.frames) {
        seen.push_back(settings);
        seen.back().camera = reference.settings.camera;
    }
    return seen;
}

}  // namespace

choose::Judged SceneLab::judge(const Settings& settings) {
    // A picture of another size is enlarged by what its pixels show, which takes a capture.
    if (settings.size != references_.frames.front().settings.size) return judgeCaptured(settings);
    tradeoff::ErrorsOfCameras errors;
    choose::Judged judged;
    const std::vector<Settings> seen = fromEachCamera(settings, references_);
    prepare(seen);
    for (std::size_t camera = 0; camera < cameras(); ++camera) {
        PreparedFrames& frames = drawn(seen[camera]);
        Frame frame;
        frame.channels[LIT] = frames.lit(0);
        errors.add(tradeoff::errorsOf(references_.frames[camera], frame));
        const FrameBytes& bytes = frames.described(0).bytes;
        judged.bytes = std::max(judged.bytes, bytes.images + bytes.buffers);
    }
    judged.error = errors.errors().at(figure_);
    return judged;
}

choose::Judged SceneLab::judgeCaptured(const Settings& settings) {
    RenderOptions drawing = options_;
    drawing.runs = 0;
    drawing.progress = {};
    const tradeoff::TradeoffRow row = tradeoff::measureRow(renderer_, settings, references_, drawing).row;
    return {row.errors.at(figure_), tradeoff::memoryOf(row)};
}

void SceneLab::prepare(std::span<const Settings> seen) {
    std::erase_if(drawn_, [&](const Drawn& each) { return std::ranges::count(seen, each.settings) == 0; });
    for (const Settings& settings : seen) {
        if (std::ranges::find(drawn_, settings, &Drawn::settings) != drawn_.end()) continue;
        drawn_.push_back({settings, renderer_.prepare(std::span(&settings, 1))});
        drawn_.back().frames.draw(0);
    }
}

PreparedFrames& SceneLab::drawn(const Settings& seen) {
    return std::ranges::find(drawn_, seen, &Drawn::settings)->frames;
}

std::vector<double> SceneLab::time(std::span<const Settings> frames, std::span<const std::size_t> order) {
    std::vector<Settings> seen;
    for (const Settings& settings : frames)
        for (Settings& each : fromEachCamera(settings, references_)) seen.push_back(std::move(each));
    prepare(seen);
    drawn(seen.front()).warmUp(std::array{std::size_t{0}});
    std::vector<double> times;
    for (const std::size_t i : order) {
        double ms = 0;
        for (std::size_t camera = 0; camera < cameras(); ++camera)
            ms += drawn(seen[i * cameras() + camera]).draw(0);
        times.push_back(ms / static_cast<double>(cameras()));
    }
    return times;
}

std::vector<std::vector<PassTime>> SceneLab::profile(const Settings& settings, int frames) {
    const Settings seen = fromEachCamera(settings, references_).front();
    prepare(std::span(&seen, 1));
    PreparedFrames& of = drawn(seen);
    of.warmUp(std::array{std::size_t{0}});
    std::vector<std::vector<PassTime>> times;
    for (int i = 0; i < frames; ++i) times.push_back(of.profile(0));
    return times;
}

}  // namespace diptych::cli
