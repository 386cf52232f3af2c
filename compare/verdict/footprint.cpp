// SPDX-License-Identifier: MIT
#include "compare/verdict/footprint.h"

#include "compare/metrics/flip.h"
#include "compare/metrics/pixel.h"
#include "compare/verdict/blended_pixels.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/environment_cost.h"
#include "compare/verdict/neighbours.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace diptych {
namespace {

// The rasteriser snaps vertices to 1/256 of a pixel, so that a pixel may show a point 1/128 of the way to
// a neighbour.
constexpr double snap = 1.0 / 128;

// 8-bit mip levels are rounded to codes and computed from rounded levels.
constexpr double mipCode = 1.0 / 255;

// Tolerance of equal surface values, as a fraction of 1 or of a radian.
constexpr double sameSurface = 1e-5;

// Channels of a surface's position, which are not filtered.
bool isGeometry(const DebugMode& mode) {
    return sourceOf(mode.channel).stage == ChannelStage::position;
}

// Channels of a surface's material; where they differ, its light may.
bool isSurface(const DebugMode& mode) {
    return mode.supported_by == SupportedBy::both && !isLit(mode.channel) && !isGeometry(mode);
}

// Largest change of the value within `radius` pixels of pixel `i`.
double rangeAt(const DebugMode& mode, const Image& image, std::size_t i, int radius = 1) {
    double range = 0;
    within(image, i, radius, [&](std::size_t j, int, int) {
        range = std::max(range, channelDifference(mode, image.pixel(j), image.pixel(i)));
    });
    return range;
}

class Evaluate {
public:
    Evaluate(const DebugMode& mode, const FramePair& pair)
        : mode_(mode),
          pair_(pair),
          baseline_(pair.baseline.channels.at(mode.channel)),
          test_(pair.test.channels.at(mode.channel)),
          error_(mode.error_kind, mode.kind, baseline_, pair.coverage),
          environment_(pair),
          blended_(pair) {
        for (const DebugMode& of : debugModes())
            if ((of.channel == mode.channel || (isLit(mode.channel) && isSurface(of))) &&
                pair.baseline.channels.contains(of.channel) && pair.test.channels.contains(of.channel))
                bounds_[of.channel] = encodingBound(of, pair);
        for (std::size_t code = 0; code < 256; ++code) exact_[code] = exactSrgb(code);
        if (!pair.texels) return;
        for (std::size_t code = 255; code > 0; --code)
            fractions_[code - 1] = fractions_[code] =
                std::max(fractions_[code], pair.texels->srgbError(code) / exact_[code]);
    }

    Footprints operator()() {
        Footprints result;
        std::vector<std::uint8_t> detailed(baseline_.pixels(), 0);
        std::vector<double> used, others_used;  // of all pixels; without those of glass
        double largest = 0;
        for (std::size_t i = 0; i < baseline_.pixels(); ++i) {
            if (!pair_.coverage.covered[i]) continue;
            const double error = error_(test_.pixel(i), baseline_.pixel(i));
            const double glass = blended_.throughGlass(mode_, i);
            const double bound = glass > 0 ? glassBound(i, glass) : isInside(i) ? boundAt(i) : -1;
            result.glass += glass > 0;
            // A number against NaN is always an error.
            if (bound < 0 && std::isfinite(error)) {
                detailed[i] = 1;
                continue;
            }
            result.max = std::max(result.max, bound);
            const double ratio = error == 0          ? 0
                                 : std::isinf(error) ? error  // whatever its bound
                                                     : error / std::max(bound, 0.0);
            used.push_back(ratio);
            if (!(glass > 0)) others_used.push_back(ratio);
            result.beyond += ratio > 1;
            if (!(ratio > largest)) continue;
            largest = ratio;
            result.x = static_cast<int>(i) % baseline_.width;
            result.y = static_cast<int>(i) / baseline_.width;
        }
        result.smooth = used.size();
        // Wide bounds of glass do not raise the number of other pixels that may be beyond theirs.
        // Filtered alpha masks may show the background at whole pixels of a hole's edge.
        const double max = pair_.needs.alpha_mask ? 0.99 : 0.999;
        result.used = std::max(nearestRank(std::move(used), max), nearestRank(std::move(others_used), max));
        const auto others = static_cast<std::uint64_t>(std::ranges::count(detailed, 1));
        if (isGeometry(mode_) || mode_.kind == ChannelKind::id)
            result.edges = others;
        else if (others > 0)
            evaluateDetail(detailed, others, result);
        return result;
    }

private:
    // Whether each image shows a single material, or the background, all around. The two materials need
    // not be equal: a difference is an error.
    bool isInside(std::size_t i) const {
        const Image *a = findChannel(pair_.baseline, Channel::material_id),
                    *b = findChannel(pair_.test, Channel::material_id);
        if (!a || !b) return true;
        bool inside = true;
        within(*a, i, 1, [&](std::size_t j, int, int) {
            inside = inside && *a->pixel(j) == *a->pixel(i) && *b->pixel(j) == *b->pixel(i);
        });
        return inside;
    }

    // Whether both images show the same surface, so that textures do not explain a difference of light.
    // Channels are only missing in Frames from files: one missing in both is ignored, one missing in one
    // may differ.
    bool isSameSurface(std::size_t i) const {
        for (const DebugMode& mode : debugModes()) {
            if (!isSurface(mode)) continue;
            const Image *a = findChannel(pair_.baseline, mode.channel),
                        *b = findChannel(pair_.test, mode.channel);
            if (!a && !b) continue;
            if (!a || !b) return false;
            const double size =
                mode.error_kind == ErrorKind::relative ? metrics::largestFinite(a->pixel(i), mode.width) : 1;
            const double same =
                (isAngle(mode.error_kind) ? degreesPerRadian : size) * sameSurface +
                (mode.error_kind == ErrorKind::relative ? size : 1) * bounds_.at(mode.channel);
            // Colours may differ by the device's decoding, for which colours() gives light a tolerance.
            const double decoded =
                mode.kind == ChannelKind::color ? texels(mode, a->pixel(i)) + darkened(mode, *a, i) : 0;
            if (!(channelDifference(mode, a->pixel(i), b->pixel(i)) <= same + decoded)) return false;
        }
        return true;
    }

    // Permitted effect of the device's decoding and filtering of 8-bit texels, in the channel's unit.
    double texels(const DebugMode& mode, const float* value) const {
        if (!pair_.texels) return 0;
        const double code = pair_.texels->linear_filter.rounding + mipCode;
        switch (mode.texels) {
            case TexelUse::none:
                return 0;
            case TexelUse::number:
                return code;
            case TexelUse::thickness:
                return code * double{pair_.needs.film_thickness_range};
            case TexelUse::length:
                return code * double{pair_.needs.volume_thickness_range};
            case TexelUse::direction:
                // Three components of 2 t - 1.
                return 2 * std::sqrt(3.0) * code * (isAngle(mode.error_kind) ? degreesPerRadian : 1);
            case TexelUse::line:
                // Two components of 2 t - 1, in the plane of a normal with three.
                return 2 * (std::sqrt(2.0) + std::sqrt(3.0)) * code * degreesPerRadian;
            case TexelUse::color:
            case TexelUse::scaled_color: {
                if (mode.error_kind == ErrorKind::relative)
                    return fractions_[1] * metrics::largestFinite(value, mode.width);
                double max = 0;
                for (int c = 0; c < mode.width; ++c) max = std::max(max, srgbBound(value[c]));
                // The specular texture scales F0, and metallic mixes it with albedo.
                return max + (mode.texels == TexelUse::scaled_color ? code : 0);
            }
        }
        return 0;
    }

    // Permitted effect on albedo of the texels of F0, which darkens the base of specular-glossiness: albedo
    // is diffuse times 1 - F0. Without that channel, both may be 1.
    double darkened(const DebugMode& mode, const Image& albedo, std::size_t i) const {
        if (mode.channel != Channel::albedo || !pair_.texels || !pair_.needs.specular_glossiness) return 0;
        const Image* const image = findChannel(pair_.baseline, Channel::dielectric_f0);
        const double f0 = image ? metrics::largestFinite(image->pixel(i), image->components) : 1;
        const double diffuse = metrics::largestFinite(albedo.pixel(i), mode.width) / std::max(1 - f0, 0.0);
        return srgbBound(f0) * (diffuse < 1 ? diffuse : 1);
    }

    // Permitted error of light of `size` by the device's colours: all of it is multiplied by one of them.
    double colours(std::size_t i, double size) const {
        if (!isLit(mode_.channel) || !pair_.texels) return 0;
        double fraction = 0;
        for (const DebugMode& mode : debugModes()) {
            if (mode.texels != TexelUse::color) continue;
            const Image* const image = findChannel(pair_.baseline, mode.channel);
            const double value = image ? metrics::largestFinite(image->pixel(i), mode.width) : 0;
            if (value > 0) fraction = std::max(fraction, texels(mode, image->pixel(i)) / value);
        }
        return fraction * size;
    }

    // Bound of a decoded colour; includes one more code for mip levels.
    double srgbBound(double value) const {
        std::size_t code = 0;
        while (code < 254 && exact_[code + 1] <= value) ++code;
        return value * fractions_[code] + exact_[code + 1] - exact_[code] +
               pair_.texels->srgb_filter.rounding;
    }

    // Largest permitted error of a smooth pixel, in the channel's error kind; negative if it is not smooth.
    double boundAt(std::size_t i) const {
        if (mode_.kind == ChannelKind::id) return 0;
        // Only the reference's range: the tested image must not widen its own tolerance.
        const bool first = isReferenceFrame(pair_.baseline);
        const Image &reference = first ? baseline_ : test_, &path = first ? test_ : baseline_;
        const double range = rangeAt(mode_, reference, i);
        const double size = std::max(metrics::largestFinite(baseline_.pixel(i), mode_.width), error_.floor());
        const double unit =
            mode_.error_kind == ErrorKind::relative ? size : 1;  // of the error, in the channel's unit
        if (isGeometry(mode_)) return (range * 2 * snap + shadingRounding * std::max(size, 1e-9)) / unit;
        // A fiftieth of the channel's range; two degrees for directions.
        const double smooth = isAngle(mode_.error_kind) ? 2 : 0.02 * unit;
        if (!(std::max(range, rangeAt(mode_, path, i)) <= smooth)) return -1;
        if (isLit(mode_.channel) && !isSameSurface(i)) return -1;
        const double rounding =
            isAngle(mode_.error_kind) ? shadingRounding * degreesPerRadian : shadingRounding * unit;
        // A device's mip level may be one step coarser, which covers two pixels. Limited to an even slope
        // of what is still smooth, because only an edge exceeds that.
        const double filtered = std::min(rangeAt(mode_, reference, i, 2), 2 * smooth);
        const double texel = texels(mode_, baseline_.pixel(i)) + darkened(mode_, baseline_, i);
        return (filtered + rounding + texel + colours(i, size)) / unit + encoding(i, unit) +
               (uncertainty(i) + environment_.allowed(mode_, i)) / unit;
    }

    double glassBound(std::size_t i, double glass) const {
        const double unit = std::max(metrics::largestFinite(baseline_.pixel(i), mode_.width), error_.floor());
        return (glass + uncertainty(i) + environment_.allowed(mode_, i)) / unit + shadingRounding +
               encoding(i, unit);
    }

    // Uncertainty of a sampled reference at 99.9 % confidence.
    double uncertainty(std::size_t i) const {
        const Image& known = pair_.reference().uncertainty;
        return isLit(mode_.channel) && !known.empty() ? surerThan95 * double{*known.pixel(i)} : 0;
    }

    // Quantization error bound, or for light the encoding's effect, in the channel's error kind.
    double encoding(std::size_t i, double unit) const {
        if (!isLit(mode_.channel)) return bounds_.at(mode_.channel);
        const Frame* const shown = encodingFrame(mode_, pair_);
        return shown ? metrics::distance(shown->channels.at(mode_.channel).pixel(i),
                                         shown->through_gbuffer.at(mode_.channel).pixel(i), mode_.width) /
                           unit
                     : 0;
    }

    // FLIP over the pixels with detail.
    void evaluateDetail(const std::vector<std::uint8_t>& detailed, std::uint64_t count,
                        Footprints& result) const {
        result.detailed = count;
        FlipOptions options;
        options.covered = detailed;
        const bool endless = mode_.error_kind == ErrorKind::relative || mode_.domain == Domain::positive;
        const double scale = endless ? exposure(detailed) : 0;
        result.flip = ldrFlip(displayed(baseline_, scale), displayed(test_, scale), options).mean;
    }

    // Exposure that maps the mean of the baseline's detail to 0.18 (Reinhard et al. 2002); 1 if it is
    // black.
    double exposure(const std::vector<std::uint8_t>& detailed) const {
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < baseline_.pixels(); ++i)
            if (detailed[i] && metrics::finite(baseline_.pixel(i), mode_.width)) {
                sum += metrics::largestFinite(baseline_.pixel(i), mode_.width);
                ++count;
            }
        return sum > 0 ? 0.18 * count / sum : 1;
    }

    // The channel as a displayable image: values without an upper end, if `scale` is not 0, by Reinhard's
    // curve and a display's gamma; other values as a display clamps them.
    Image displayed(const Image& image, double scale) const {
        Image mapped(image.width, image.height, 3);
        for (std::size_t i = 0; i < image.pixels(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double value = image.pixel(i)[std::min(c, image.components - 1)],
                             exposed = scale * value;
                const double shown = scale > 0                   ? std::pow(exposed / (1 + exposed), 1 / 2.2)
                                     : isAngle(mode_.error_kind) ? 0.5 * value + 0.5
                                                                 : value;
                mapped.pixel(i)[c] = static_cast<float>(std::clamp(shown, 0.0, 1.0));
            }
        return mapped;
    }

    const DebugMode& mode_;
    const FramePair& pair_;
    const Image &baseline_, &test_;
    PixelError error_;
    EnvironmentCost environment_;
    BlendedPixels blended_;
    std::map<Channel, double> bounds_;  // encodingBound() of the surface's channels
    std::array<double, 256> exact_{};
    // Largest relative decoding error over codes from this one on: a factor may have darkened the texel,
    // never brightened it.
    std::array<double, 256> fractions_{};
};

}  // namespace

Tolerance footprintTolerance(const Footprints& footprints) {
    std::string because = fmt::format(
        "{} with smooth surroundings in both images; the bound of each is the reference's change within two "
        "pixels, 8-bit texel filtering, G-buffer quantization and 1e-4",
        counted(footprints.smooth, "pixel"));
    if (footprints.glass > 0)
        because += fmt::format("; {} may have {}", counted(footprints.glass, "pixel"), throughGlassBecause);
    if (footprints.detailed > 0)
        because += fmt::format("; the other {} may have a mean FLIP of {} and have {:.3g}",
                               footprints.detailed, detailFlip, footprints.flip);
    if (footprints.edges > 0) because += fmt::format("; {} at edges have no limit", footprints.edges);
    return {footprints.max, because, true};
}

double Footprints::closeFraction() const {
    return pixels() > 0 ? static_cast<double>(smooth) / static_cast<double>(pixels()) : 1;
}

std::vector<Channel> footprintChannels() {
    std::vector<Channel> channels{Channel::material_id};
    for (const DebugMode& mode : debugModes())
        if (isSurface(mode) && mode.channel != channels.front()) channels.push_back(mode.channel);
    return channels;
}

std::optional<Footprints> footprints(const DebugMode& mode, const FramePair& pair) {
    if (!isPathAgainstReference(pair) || pair.reference().settings.reference_mode != ReferenceMode::scene)
        return {};
    return Evaluate(mode, pair)();
}

}  // namespace diptych
