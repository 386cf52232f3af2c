// SPDX-License-Identifier: MIT
#include "compare/verdict/encoding_use.h"

#include "compare/metrics/pixel.h"
#include "shared/contract/encoded_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych {
namespace {

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

// Floats of 16 bits round to this part of a number. What turns a normal is in the bound already (HALF_TURN of
// shaders/lib/encoded_surface.glsl); left are roundings of factors, each counted as often as light has the
// factor as a power.
constexpr double halfRoundoff = 0x1p-11;
// Of diffuse light: the cast of its factor, four in the share that the layer leaves, five of a cosine that is
// off by three in the fifth power there, and the product.
constexpr double halfDiffuse = 1 + 4 + 5 * 3 + 1;
// Of a lobe: k, which goes squared, has a cast of alpha, four roundings of (alpha n.h)^2, four of |n x h|^2,
// their sum, and a division, of 2.5 ULP; then 13 of the visibility, another division among them, 6 of
// Fresnel's term, and 3 of the products.
constexpr double halfLobe = 2 * (1 + 4 + 4 + 1 + 5) + 13 + 6 + 3;
// Deferred's picture, that of forward+, and the latter again, from which the bound is measured.
constexpr double halfPictures = 3;

// The largest part of a lit channel by which 16 bits may be off, beside what they turn.
double halfErrorOf(int mode, const Settings& settings) {
    if (settings.shading_precision != ShadingPrecision::fp16 || isAmbient(mode)) return 0;
    const bool diffuse = mode == static_cast<int>(gpu::DEBUG_lit_diffuse);
    return halfPictures * halfRoundoff * (diffuse ? halfDiffuse : halfLobe);
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
                               shadingRounding * std::max(size, dark_ * floor_) + half_ * size +
                               steps(i) * std::max(size, leastNormal);
        return {
            allowed,
            allowed / std::max(metrics::largestFinite(baseline_->pixel(i), baseline_->components), floor_)};
    }
    // Why more is allowed than the bits of the G-buffer and float32's rounding: "; and ..." or nothing.
    std::string beside() const {
        std::string words;
        if (step_ > 0)
            words += fmt::format("; plus {} steps of {}, each {:.3g} of lit", stepsOfPictures,
                                 nameOf(own_settings_->lit_format), step_);
        if (half_ > 0)
            words += fmt::format(
                "; plus {:.3g} of lit for 16-bit float rounding (each {:.3g}) and normals rotated by 12 "
                "roundings",
                half_, halfRoundoff);
        return words;
    }
    // Deferred's image, and that of forward+.
    const Image& read() const { return *read_; }
    const Image& own() const { return *own_; }

private:
    static constexpr gpu::uint stepsOfPictures = 2 + gpu::SURFACE_END - gpu::SURFACE_RAISED;

    // Each picture is rounded to its format by up to one step, and again with each layer that is blended over
    // it: of up to 8 layers, as many as --transparency-layers has. So are those of moved surfaces, whose
    // differences make the bound, and which hide what is less than a step.
    double steps(std::size_t i) const {
        const bool blended = unblended_->pixels() > 0 &&
                             metrics::distance(own_->pixel(i), unblended_->pixel(i), own_->components) != 0;
        return stepsOfPictures * step_ * (blended ? 9 : 1);
    }

    Allowance(const DebugMode& mode, const FramePair& pair, const Frame& deferred, const Frame& forward)
        : read_(&deferred.channels.at(mode.number)),
          own_(&forward.channels.at(mode.number)),
          baseline_(&pair.baseline.channels.at(mode.number)),
          bound_(boundOf(forward, mode)),
          unblended_(&forward.unblended),
          own_settings_(&forward.settings),
          step_(mode.number == static_cast<int>(gpu::DEBUG_lit) ? stepOf(forward.settings.lit_format) : 0),
          half_(halfErrorOf(mode.number, forward.settings)),
          dark_(roundedFloors(pair.needs)),
          floor_(PixelError(mode.metric, mode.kind, *baseline_, pair.coverage).floor()) {}

    const Image *read_, *own_, *baseline_, *bound_, *unblended_;
    const Settings* own_settings_;
    double step_, half_, dark_, floor_;
};

}  // namespace

double roundedFloors(const Requirements& needs) {
    // Integrals over area lights are sums of terms that cancel: in the lobe's tail float32's rounding is that
    // of a tenth of the mean luminance. (Ten times left two pixels of builtin:areas at 333x187 beyond,
    // by 1.13.)
    constexpr double areaCancelling = 100;
    return needs.areaLights() > 0 ? areaCancelling : 1;
}

std::optional<EncodingUse> encodingUse(const DebugMode& mode, const FramePair& pair) {
    const std::optional<Allowance> allowance = Allowance::of(mode, pair);
    if (!allowance) return {};
    const Image &read = allowance->read(), &own = allowance->own();
    EncodingUse use;
    use.beside = allowance->beside();
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
