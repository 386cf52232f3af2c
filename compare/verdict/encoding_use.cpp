// SPDX-License-Identifier: MIT
#include "compare/verdict/encoding_use.h"

#include "compare/metrics/pixel.h"

#include <algorithm>
#include <cmath>

namespace diptych {
namespace {

// What is darker than this many floors of the metric is rounded as brighter light. Integrals over area lights
// are sums of terms that cancel, so that in the lobe's tail float32's rounding is that of a tenth of the mean
// luminance. (Ten times left two pixels of builtin:areas at 333x187 beyond, by 1.13.)
constexpr double areaCancelling = 100;

double cancelling(const Requirements& needs) {
    return needs.areaLights() > 0 ? areaCancelling : 1;
}

const Image* boundOf(const Frame& forward, const DebugMode& mode) {
    const auto found = forward.encoding_bound.find(mode.number);
    return found == forward.encoding_bound.end() ? nullptr : &found->second;
}

}  // namespace

std::optional<EncodingUse> encodingUse(const DebugMode& mode, const FramePair& pair) {
    const Frame *deferred = pair.of(Path::deferred), *forward = pair.of(Path::forward_plus);
    if (!isLit(mode.number) || !deferred || !forward ||
        deferred->settings.gbuffer != forward->settings.gbuffer || forward->encoding_bound.empty())
        return {};
    const Image& read = deferred->channels.at(mode.number);
    const Image& own = forward->channels.at(mode.number);
    const Image& baseline = pair.baseline.channels.at(mode.number);
    const Image* const bound = boundOf(*forward, mode);
    const double floor = PixelError(mode.metric, mode.kind, baseline, pair.coverage).floor();
    EncodingUse use;
    for (std::size_t i = 0; i < own.pixels(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const double size = std::max(metrics::largestFinite(own.pixel(i), own.components),
                                     metrics::largestFinite(read.pixel(i), read.components));
        const double allowed = (bound ? double{*bound->pixel(i)} : 0) +
                               shadingRounding * std::max(size, cancelling(pair.needs) * floor);
        const double inMetric =
            allowed / std::max(metrics::largestFinite(baseline.pixel(i), baseline.components), floor);
        if (std::isfinite(inMetric)) {
            use.most = std::max(use.most, inMetric);
            use.mean += inMetric;
        }
        const double difference = metrics::distance(read.pixel(i), own.pixel(i), own.components);
        if (difference == 0) continue;
        const double used = difference / allowed;
        use.beyond += !(used <= 1);
        if (used > use.used) {
            use.used = used;
            use.x = static_cast<int>(i % static_cast<std::size_t>(own.width));
            use.y = static_cast<int>(i / static_cast<std::size_t>(own.width));
        }
    }
    if (pair.coverage.count > 0) use.mean /= static_cast<double>(pair.coverage.count);
    return use;
}

const Image* allowedByBits(const DebugMode& mode, const FramePair& pair) {
    const Frame& path = isReferenceFrame(pair.baseline) ? pair.test : pair.baseline;
    if (!isLit(mode.number) || isReferenceFrame(pair.baseline) == isReferenceFrame(pair.test) ||
        path.settings.path != Path::deferred || path.settings.gbuffer == GBufferEncoding::full ||
        !pair.explaining || pair.explaining->settings.gbuffer != path.settings.gbuffer)
        return nullptr;
    return boundOf(*pair.explaining, mode);
}

}  // namespace diptych
