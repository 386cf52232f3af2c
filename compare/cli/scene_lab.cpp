// SPDX-License-Identifier: MIT
#include "compare/cli/scene_lab.h"

#include <numeric>

namespace diptych::cli {

choose::Judged SceneLab::judge(const Settings& settings) {
    RenderOptions drawing = options_;
    drawing.runs = 0;
    drawing.progress = {};
    const tradeoff::TradeoffRow row = tradeoff::measureRow(renderer_, settings, references_, drawing).row;
    return {row.errors.at(figure_), tradeoff::memoryOf(row)};
}

PreparedFrames SceneLab::prepared(std::span<const Settings> frames) {
    std::vector<Settings> seen;
    for (const Settings& settings : frames)
        for (const Frame& reference : references_.frames) {
            seen.push_back(settings);
            seen.back().camera = reference.settings.camera;
        }
    PreparedFrames result = renderer_.prepare(seen);
    std::vector<std::size_t> all(seen.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const std::size_t i : all) result.draw(i);
    result.warmUp(all);
    return result;
}

std::vector<double> SceneLab::time(std::span<const Settings> frames, std::span<const std::size_t> order) {
    PreparedFrames drawn = prepared(frames);
    std::vector<double> times;
    for (const std::size_t i : order) {
        double ms = 0;
        for (std::size_t camera = 0; camera < cameras(); ++camera) ms += drawn.draw(i * cameras() + camera);
        times.push_back(ms / static_cast<double>(cameras()));
    }
    return times;
}

std::vector<std::vector<PassTime>> SceneLab::profile(std::span<const Settings> frames,
                                                     std::span<const std::size_t> order) {
    PreparedFrames drawn = prepared(frames);
    std::vector<std::vector<PassTime>> times;
    for (const std::size_t i : order) {
        std::vector<PassTime>& passes = times.emplace_back();
        for (std::size_t camera = 0; camera < cameras(); ++camera)
            for (PassTime pass : drawn.profile(i * cameras() + camera)) {
                pass.ms /= static_cast<double>(cameras());
                passes.push_back(std::move(pass));
            }
    }
    return times;
}

}  // namespace diptych::cli
