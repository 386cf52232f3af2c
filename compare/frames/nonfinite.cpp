// SPDX-License-Identifier: MIT
#include "compare/frames/nonfinite.h"

#include "shared/frame/debug_modes.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace diptych {

std::uint64_t nonfinitePixels(const Image& image) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* p = image.pixel(i);
        count += !std::all_of(p, p + image.components, [](float v) { return std::isfinite(v); });
    }
    return count;
}

std::vector<std::uint32_t> replaceNonfinite(Image& image) {
    std::vector<std::uint32_t> repaired;
    if (nonfinitePixels(image) == 0) return repaired;
    constexpr float max = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        float* const p = image.pixel(i);
        if (std::all_of(p, p + image.components, [](float v) { return std::isfinite(v); })) continue;
        repaired.push_back(static_cast<std::uint32_t>(i));
        for (int c = 0; c < image.components; ++c)
            if (!std::isfinite(p[c])) p[c] = std::isnan(p[c]) ? 0.0f : std::copysign(max, p[c]);
    }
    return repaired;
}

void recordNonfinite(Frame& frame, Channel channel, const std::vector<std::uint32_t>& pixels) {
    if (pixels.empty()) return;
    std::vector<std::uint32_t>& all = frame.repaired[channel];
    std::vector<std::uint32_t> both;
    std::ranges::set_union(all, pixels, std::back_inserter(both));
    all = std::move(both);
}

std::vector<std::string> nonfiniteText(const Frame& frame) {
    std::vector<std::string> lines;
    const auto width = static_cast<std::uint32_t>(frame.settings.size.width);
    for (const auto& [mode, pixels] : frame.repaired)
        lines.push_back(
            fmt::format("{} was NaN or infinite at {}, the first at {},{}: replaced by 0 or the largest "
                        "number, magenta in pictures",
                        debugMode(mode).name, counted(pixels.size(), "pixel"), pixels.front() % width,
                        pixels.front() / width));
    return lines;
}

}  // namespace diptych
