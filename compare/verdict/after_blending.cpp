// SPDX-License-Identifier: MIT
#include "compare/verdict/after_blending.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace diptych {
namespace {

// lit before and after blending, W x H x 3.
struct Blending {
    const Image* before = nullptr;
    const Image* after = nullptr;
};

Blending blendingOf(const Frame& frame) {
    const Image* const lit = findChannel(frame, Channel::lit);
    return lit && !frame.unblended.empty() ? Blending{&frame.unblended, lit} : Blending{};
}

// The same after the G-buffer's encoding if that is lossy: in a pair of both paths, only differences that
// the encoding does not explain count.
Blending encodedBlendingOf(const Frame& forward, const Frame& other) {
    const Image* const lit = findChannel(forward.through_gbuffer, Channel::lit);
    if (!shadesFragments(forward.settings.path) || !isPacked(other.settings) ||
        forward.settings.gbuffer != other.settings.gbuffer || !lit ||
        forward.unblended_through_gbuffer.empty())
        return blendingOf(forward);
    return {&forward.unblended_through_gbuffer, lit};
}

bool isBlended(const Blending& of, std::size_t i) {
    return metrics::distance(of.before->pixel(i), of.after->pixel(i), of.after->components) != 0;
}

void take(AfterBlending& found, double error, std::size_t pixel, int width) {
    if (found.pixels++ > 0 && !(error > found.largest)) return;
    found.largest = error;
    found.x = static_cast<int>(pixel) % width;
    found.y = static_cast<int>(pixel) / width;
}

AfterBlending ofPaths(const FramePair& pair, const Blending& a, const Blending& b) {
    AfterBlending found;
    const DebugMode& lit = debugMode(Channel::lit);
    const PixelError error(lit.error_kind, lit.kind, *a.after, pair.coverage);
    for (std::size_t i = 0; i < a.after->pixels(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        found.covered += isBlended(a, i) || isBlended(b, i) ? 1 : 0;
        const double before = metrics::distance(a.before->pixel(i), b.before->pixel(i), 3),
                     after = metrics::distance(a.after->pixel(i), b.after->pixel(i), 3);
        found.before += before > 0 ? 1 : 0;
        const double rounding = before == 0 && pair.cpu
                                    ? 0
                                    : gpuUlps * 0x1p-23 *
                                          std::max({metrics::largestFinite(a.after->pixel(i), 3),
                                                    metrics::largestFinite(b.after->pixel(i), 3),
                                                    metrics::largestFinite(a.before->pixel(i), 3)});
        if (after > before + rounding || (std::isinf(after) && !std::isinf(before)))
            take(found, error(b.after->pixel(i), a.after->pixel(i)), i, a.after->width);
    }
    return found;
}

AfterBlending ofReference(const FramePair& pair, const Blending& a, const Blending& b) {
    AfterBlending found;
    const DebugMode& lit = debugMode(Channel::lit);
    const double max = derivedTolerance(lit, pair).max;
    const std::vector<double> before = openErrors(lit, pair, *a.before, *b.before),
                              after = openErrors(lit, pair, *a.after, *b.after);
    std::size_t next = 0;
    for (std::size_t i = 0; i < a.after->pixels(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const std::size_t k = next++;
        found.covered += isBlended(a, i) || isBlended(b, i) ? 1 : 0;
        const bool differed = !(before[k] <= max);
        found.before += differed ? 1 : 0;
        if (!differed && !(after[k] <= max)) take(found, after[k], i, a.after->width);
    }
    found.allowed = (found.covered + 999) / 1000;
    return found;
}

}  // namespace

std::optional<AfterBlending> afterBlending(const FramePair& pair) {
    const Blending a = encodedBlendingOf(pair.baseline, pair.test),
                   b = encodedBlendingOf(pair.test, pair.baseline);
    if (a.before == nullptr || b.before == nullptr) return {};
    if (!pair.hasReference()) return ofPaths(pair, a, b);
    if (pair.reference().settings.reference_mode != ReferenceMode::surface) return {};
    return ofReference(pair, a, b);
}

std::string faultOf(const AfterBlending& found) {
    if (found.passed()) return {};
    return fmt::format(
        "the transparent draw adds a difference in lit at {} (largest {:.3g} at {},{}); blended fragments "
        "cover {}, and {} differed before the draw{}",
        counted(found.pixels, "pixel"), found.largest, found.x, found.y, counted(found.covered, "pixel"),
        found.before,
        found.allowed > 0 ? fmt::format("; tolerance: {}", counted(found.allowed, "pixel")) : "");
}

}  // namespace diptych
