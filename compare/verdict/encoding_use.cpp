// SPDX-License-Identifier: MIT
#include "compare/verdict/encoding_use.h"

#include "compare/metrics/pixel.h"
#include "shared/contract/encoded_surface.h"

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

// The least number that formats of 16, 11 and 10 bits hold with all their bits.
constexpr double leastNormal = 0x1p-14;

// The largest step of a format of lit, relative to what it holds.
double stepOf(LitFormat format) {
    switch (format) {
        case LitFormat::fp32:
            break;
        case LitFormat::fp16:
            return 0x1p-10;
        case LitFormat::b10g11r11:
            return 0x1p-5;  // of blue
    }
    return 0;
}

// What every pixel of two paths may differ by; nothing of other pairs and channels, and without bounds.
class Allowance {
public:
    static std::optional<Allowance> of(const DebugMode& mode, const FramePair& pair) {
        const Frame *deferred = pair.of(Path::deferred), *forward = pair.of(Path::forward_plus);
        if (!isLit(mode.number) || !deferred || !forward ||
            deferred->settings.gbuffer != forward->settings.gbuffer || forward->encoding_bound.empty())
            return {};
        return Allowance(mode, pair, *deferred, *forward);
    }

    EncodingAllowed operator()(std::size_t i) const {
        const double size = std::max(metrics::largestFinite(own_->pixel(i), own_->components),
                                     metrics::largestFinite(read_->pixel(i), read_->components));
        const double allowed = (bound_ ? double{*bound_->pixel(i)} : 0) +
                               shadingRounding * std::max(size, dark_ * floor_) +
                               steps(i) * std::max(size, leastNormal);
        return {
            allowed,
            allowed / std::max(metrics::largestFinite(baseline_->pixel(i), baseline_->components), floor_)};
    }
    // Deferred's image, and that of forward+.
    const Image& read() const { return *read_; }
    const Image& own() const { return *own_; }

private:
    // Each picture is rounded to its format by up to one step, and again with each layer that is blended over
    // it: of up to 8 layers, as many as --transparency-layers has. So are those of moved surfaces, whose
    // differences make the bound, and which hide what is less than a step.
    double steps(std::size_t i) const {
        const bool blended = unblended_->pixels() > 0 &&
                             metrics::distance(own_->pixel(i), unblended_->pixel(i), own_->components) != 0;
        constexpr auto moved = double{gpu::SURFACE_END - gpu::SURFACE_RAISED};
        return (2 + moved) * step_ * (blended ? 9 : 1);
    }

    Allowance(const DebugMode& mode, const FramePair& pair, const Frame& deferred, const Frame& forward)
        : read_(&deferred.channels.at(mode.number)),
          own_(&forward.channels.at(mode.number)),
          baseline_(&pair.baseline.channels.at(mode.number)),
          bound_(boundOf(forward, mode)),
          unblended_(&forward.unblended),
          step_(mode.number == static_cast<int>(gpu::DEBUG_lit) ? stepOf(forward.settings.lit_format) : 0),
          dark_(cancelling(pair.needs)),
          floor_(PixelError(mode.metric, mode.kind, *baseline_, pair.coverage).floor()) {}

    const Image *read_, *own_, *baseline_, *bound_, *unblended_;
    double step_, dark_, floor_;
};

}  // namespace

std::optional<EncodingUse> encodingUse(const DebugMode& mode, const FramePair& pair) {
    const std::optional<Allowance> allowance = Allowance::of(mode, pair);
    if (!allowance) return {};
    const Image &read = allowance->read(), &own = allowance->own();
    EncodingUse use;
    for (std::size_t i = 0; i < own.pixels(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const auto [allowed, inMetric] = (*allowance)(i);
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

std::optional<EncodingAllowed> encodingAllowed(const DebugMode& mode, const FramePair& pair,
                                               std::size_t pixel) {
    const std::optional<Allowance> allowance = Allowance::of(mode, pair);
    return allowance ? std::optional((*allowance)(pixel)) : std::nullopt;
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
