// SPDX-License-Identifier: MIT
#include "compare/verdict/device_bounds.h"

#include "compare/metrics/pixel.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych {
namespace {

// A triangle that ends halfway to the next pixel, followed by no change, changes twice as much as is
// visible.
constexpr double kink = 2;

// Relative difference of two devices' sRGB decoding, indexed by the smallest possible code (a factor may
// have darkened a texel, never brightened it). As measured, and at most what Vulkan permits, half a code
// each.
std::array<double, 256> decodeFractions(const AcrossDevices& across) {
    std::array<double, 256> fractions{};
    const auto &a = across.devices[0].texels, &b = across.devices[1].texels;
    double max = 0;
    for (std::size_t code = 255; code > 0; --code) {
        const double exact = exactSrgb(code), code_step = exact - exactSrgb(code - 1),
                     allowed = code < 255 ? std::max(code_step, exactSrgb(code + 1) - exact) : code_step,
                     measured = a && b ? std::abs(double{a->srgb[code]} - double{b->srgb[code]}) : allowed;
        max = std::max(max, std::min(allowed, measured) / exact);
        fractions[code] = max;
    }
    fractions[0] = max;
    return fractions;
}

// Rounding of 8-bit texels by both devices' filters: as measured, and at most one code each.
double filterRounding(const AcrossDevices& across, bool srgb) {
    double sum = 0;
    for (const DevicePrecision& device : across.devices)
        sum += !device.texels
                   ? 1.0 / 255
                   : std::min(1.0 / 255,
                              (srgb ? device.texels->srgb_filter : device.texels->linear_filter).rounding);
    return sum;
}

// Visibilities that differ by more than their rounding.
bool visibilitiesDiffer(const Image& a, std::size_t i, const Image& b, std::size_t j) {
    const float p = *a.pixel(i), q = *b.pixel(j);
    return metrics::distance(p, q) > 2 * shadingRounding || (p == 0) != (q == 0);
}

// Pixels below this many floors of the error (PixelError) round like a pixel of this many. Integrals over
// area lights sum terms that cancel: in the lobe's tail, float32 rounding is that of a tenth of the mean
// luminance. (With ten floors, two pixels of builtin:areas at 333x187 were out of tolerance, by 1.13.)
double roundedFloors(const Requirements& needs) {
    return needs.areaLights() > 0 ? 100 : 1;
}

// Change of a channel per unit of a linear texel, in the channel's unit: directions have components 2 t - 1.
double perTexel(const DebugMode& mode, const Requirements& needs) {
    switch (mode.texels) {
        case TexelUse::direction:
            return 2 * std::sqrt(3.0) * (isAngle(mode.error_kind) ? degreesPerRadian : 1);
        case TexelUse::line:  // two components, in the plane of a normal with three
            return 2 * (std::sqrt(2.0) + std::sqrt(3.0)) * degreesPerRadian;
        case TexelUse::thickness:
            return double{needs.film_thickness_range};
        case TexelUse::length:
            return double{needs.volume_thickness_range};
        case TexelUse::none:  // texels at most remove its layer
            return 0;
        default:
            return 1;
    }
}

}  // namespace

PixelBound::PixelBound(const DebugMode& mode, const FramePair& pair, const Image& baseline, const Image& test)
    : mode_(mode),
      grid_(*pair.grid),
      images_{&baseline, &test},
      step_(kink * stepOf(pair.across->devices, &DevicePrecision::sub_pixel_bits)) {}

double PixelBound::operator()(std::size_t i) const {
    if (grid_.narrow[i] != 0) {
        const unsigned seen = grid_.material[i];
        if ((seen & across_bits) == 0 || (seen & down_bits) == 0)
            return std::numeric_limits<double>::infinity();
        return std::max(change(*images_[0], i, seen), change(*images_[1], i, seen));
    }
    // The smaller change of both images, so that an error in one does not widen its own tolerance.
    const unsigned seen = grid_.surface[i];
    const double changes = std::min(change(*images_[0], i, seen), change(*images_[1], i, seen));
    return std::min(1.0, step_ * double{grid_.steeper[i]}) * changes;
}

double PixelBound::change(const Image& image, std::size_t i, unsigned seen) const {
    double max = 0;
    aroundPixel(image, i, [&](std::size_t j, unsigned bit) {
        if ((seen & bit) == 0) return;
        const double to = channelDifference(mode_, image.pixel(i), image.pixel(j));
        if (std::isfinite(to)) max = std::max(max, to);
    });
    return max;
}

Shadowed::Shadowed(const FramePair& pair) {
    for (const Channel mode : {Channel::shadow_visibility, Channel::local_visibility})
        if (const Image* a = findChannel(pair.baseline, mode), *b = findChannel(pair.test, mode); a && b) {
            const Image* const relit = findChannel(pair.across->relit, mode);
            images_.push_back({relit ? relit : a, b, a});
        }
}

bool Shadowed::differs(std::size_t i) const {
    return std::ranges::any_of(images_, [i](const auto& of) {
        return visibilitiesDiffer(*of[0], i, *of[1], i) || visibilitiesDiffer(*of[2], i, *of[1], i);
    });
}

double Shadowed::relative(std::size_t i) const {
    double sum = 0;
    for (const auto& [a, b, baseline] : images_)
        if (const double min = std::min(*a->pixel(i), *b->pixel(i)); min > 0)
            sum += metrics::distance(*a->pixel(i), *b->pixel(i)) / min;
    return sum;
}

bool Shadowed::isBesideEdge(std::size_t i) const {
    bool found = false;
    for (const auto& of : images_)
        for (const Image* image : of)
            aroundPixel(*image, i, [&](std::size_t j, unsigned) {
                found = found || visibilitiesDiffer(*image, i, *image, j);
            });
    return found;
}

DeviceBounds::Kind DeviceBounds::kindOf(const DebugMode& mode) {
    switch (sourceOf(mode.channel).stage) {
        case ChannelStage::position:
        case ChannelStage::haze:
            return Kind::position;
        case ChannelStage::facet:
            return Kind::facet;
        case ChannelStage::light:
        case ChannelStage::unshadowed:
            return layerOf(mode.channel) != 0 ? Kind::part : Kind::light;
        case ChannelStage::visibility:
            return Kind::visibility;
        case ChannelStage::list:
            return Kind::list;
        case ChannelStage::id:
            return Kind::id;
        case ChannelStage::surface:
        case ChannelStage::map:
            if (sourceOf(mode.channel).part == MaterialPart::transmission) return Kind::pane;
            return mode.error_kind == ErrorKind::exact ? Kind::step : Kind::surface;
    }
    return Kind::surface;
}

DeviceBounds::DeviceBounds(const DebugMode& mode, const FramePair& pair)
    : mode_(mode),
      across_(*pair.across),
      kind_(kindOf(mode)),
      baseline_(pair.baseline.channels.at(mode.channel)),
      test_(pair.test.channels.at(mode.channel)),
      error_(mode.error_kind, mode.kind, baseline_, pair.coverage),
      position_(mode, pair, baseline_, test_),
      facet_(pair),
      rounded_as_(roundedFloors(pair.needs) * error_.floor()),
      per_texel_(kind_ == Kind::pane && pair.needs.textures == 0 ? 0 : perTexel(mode, pair.needs)),
      bits_(kind_ == Kind::surface ? 2 * encodingBound(mode, pair) : 0),
      texels_(findChannel(across_.texels, mode.channel)),
      expected_(findChannel(across_.relit, mode.channel)),
      darkens_(mode.channel == Channel::albedo && pair.needs.specular_glossiness),
      f0_(findChannel(pair.baseline, Channel::dielectric_f0)),
      shadowed_(pair) {
    // Diffuse and specular light round like lit, in integrals over the same lights.
    if (const Image* lit = findChannel(pair.baseline, Channel::lit);
        lit && kind_ == Kind::light && pair.needs.areaLights() > 0) {
        const DebugMode& whole = debugMode(Channel::lit);
        rounded_as_ =
            std::max(rounded_as_, roundedFloors(pair.needs) *
                                      PixelError(whole.error_kind, whole.kind, *lit, pair.coverage).floor());
    }
    if (mode.channel == Channel::lit && !pair.baseline.unblended.empty() && !pair.test.unblended.empty())
        unblended_ = {&pair.baseline.unblended, &pair.test.unblended};
    if (!texels_ || !isColor()) return;
    fractions_ = decodeFractions(across_);
    for (std::size_t code = 0; code < 256; ++code) exact_[code] = exactSrgb(code);
}

double DeviceBounds::operator()(std::size_t i) const {
    const double size = std::max(metrics::largestFinite(baseline_.pixel(i), mode_.width), error_.floor());
    const double unit = mode_.error_kind == ErrorKind::relative ? size : 1;
    const double rounding = relativeRounding() * (isAngle(mode_.error_kind) ? degreesPerRadian : size);
    switch (kind_) {
        case Kind::id:
            return 0;
        case Kind::step:
            return isBeside(i) ? 1 : 0;
        case Kind::facet:
            return facet_(i);
        case Kind::position:
            return (position_(i) + rounding) / unit;
        case Kind::surface:
            return (position_(i) + rounding + textures(i)) / unit + bits_;
        case Kind::pane:
            return (std::min(toNeighbours(baseline_, i), toNeighbours(test_, i)) + rounding +
                    filterRounding(across_, false) * per_texel_) /
                   unit;
        case Kind::light:
            return 2 * shadingRounding * std::max(1.0, rounded_as_ / size) + shadowed_.relative(i);
        case Kind::visibility:
            return 2 * shadingRounding;
        case Kind::part:
        case Kind::list:
            return std::numeric_limits<double>::infinity();
    }
    return 0;
}

double DeviceBounds::error(std::size_t i) const {
    if (kind_ != Kind::light) return error_(test_.pixel(i), baseline_.pixel(i));
    const Image &lit = unblended_[1] ? *unblended_[1] : test_, &expected = expected_ ? *expected_ : baseline_;
    const double difference =
        std::max(metrics::distance(lit.pixel(i), expected.pixel(i), mode_.width), blendedDifference(i));
    return difference == 0 ? 0
                           : difference / std::max(metrics::largestFinite(baseline_.pixel(i), mode_.width),
                                                   error_.floor());
}

double DeviceBounds::blendedDifference(std::size_t i) const {
    if (!unblended_[0] || !unblended_[1]) return 0;
    const double beside =
        std::max({metrics::distance(unblended_[0]->pixel(i), unblended_[1]->pixel(i), mode_.width),
                  toNeighbours(baseline_, i), toNeighbours(test_, i)});
    return std::max(0.0, metrics::distance(baseline_.pixel(i), test_.pixel(i), mode_.width) - beside);
}

double DeviceBounds::toNeighbours(const Image& image, std::size_t i) const {
    double max = 0;
    aroundPixel(image, i, [&](std::size_t j, unsigned) {
        max = std::max(max, metrics::distance(image.pixel(i), image.pixel(j), mode_.width));
    });
    return max;
}

std::string DeviceBounds::because() const {
    const auto& [a, b] = across_.devices;
    const std::string placed = fmt::format(
        "vertices snap to 1/{} and 1/{} of a pixel: the bound is that fraction of the change to the next "
        "pixel",
        1u << a.sub_pixel_bits, 1u << b.sub_pixel_bits);
    switch (kind_) {
        case Kind::id:
            return "an index is stored exactly";
        case Kind::step:
            return "an index; where it changes, a neighbour's value is allowed";
        case Kind::facet:
            return "a triangle's normal, from positions rounded to 2^-24 of their distance, then packed";
        case Kind::position:
            return placed + fmt::format("; plus {:.2g} of the value for rounding", relativeRounding());
        case Kind::surface: {
            std::string text = placed;
            if (texels_)
                text += "; filter weights have " +
                        fmt::format("{} and {} bits", a.sub_texel_bits, b.sub_texel_bits) +
                        "; Vulkan does not fix the level of detail, so each device may return any mean of "
                        "the texels in reach" +
                        decoding();
            if (bits_ > 0)
                text += fmt::format("; plus the quantization bound of both G-buffers, {:.3g}", bits_);
            return text;
        }
        case Kind::pane:
            return "surfaces with transmission, drawn over others: no more than neighbouring pixels differ" +
                   std::string(per_texel_ > 0 ? decoding() : "");
        case Kind::light:
            return fmt::format(
                "{} shades the surfaces that {} rendered, both in float32: 1e-4 each{} before blending; "
                "after blending, no more than neighbouring pixels differ",
                a.name, b.name,
                rounded_as_ > error_.floor()
                    ? " (relative to at least a tenth of the mean luminance: area-light integrals cancel)"
                    : "");
        case Kind::visibility:
            return "float32 weights, 1e-4 each; at a shadow boundary, texels of the map may show another "
                   "triangle";
        case Kind::part:
            return "a part of lit, which is compared";
        case Kind::list:
            return "each device uses the cell size that is cheapest on it; lights missing from a list show "
                   "in lit";
    }
    return {};
}

bool DeviceBounds::isBeside(std::size_t i) const {
    bool found = false;
    for (const Image* image : {&baseline_, &test_})
        aroundPixel(*image, i, [&](std::size_t j, unsigned) {
            const float value = *image->pixel(j);
            found = found || (value == *test_.pixel(i)) != (value == *baseline_.pixel(i));
        });
    return found;
}

bool DeviceBounds::isColor() const {
    return mode_.texels == TexelUse::color || mode_.texels == TexelUse::scaled_color;
}

double DeviceBounds::decoded(double value) const {
    const bool radiance = mode_.error_kind == ErrorKind::relative;
    std::size_t code = radiance ? 1 : 0;  // a factor may have brightened it
    while (!radiance && code < 254 && exact_[code + 1] <= value) ++code;
    return value * fractions_[code];
}

// Albedo is diffuse times 1 - F0. Without that channel, both may be 1.
double DeviceBounds::darkened(std::size_t i) const {
    if (!darkens_) return 0;
    const double f0 = f0_ ? metrics::largestFinite(f0_->pixel(i), f0_->components) : 1;
    const double diffuse = metrics::largestFinite(baseline_.pixel(i), mode_.width) / std::max(1 - f0, 0.0);
    return (decoded(f0) + filterRounding(across_, true)) * (diffuse < 1 ? diffuse : 1);
}

double DeviceBounds::textures(std::size_t i) const {
    if (!texels_) return 0;
    double max = *texels_->pixel(i);
    if (isColor()) {
        for (int c = 0; c < mode_.width; ++c)
            max = std::max(max, *texels_->pixel(i) + decoded(std::abs(double{baseline_.pixel(i)[c]})));
        max += filterRounding(across_, true) + darkened(i);
    }
    // Linear texels; they mix F0.
    if (!isColor() || mode_.texels == TexelUse::scaled_color)
        max += filterRounding(across_, false) * per_texel_;
    return max;
}

std::string DeviceBounds::decoding() const {
    if (!isColor())
        return "; filters round by up to " +
               fmt::format("{:.2g} of an 8-bit step", 255 * filterRounding(across_, false));
    return fmt::format("; their sRGB decoding differs by up to {:.2g} %", 100 * fractions_[1]);
}

BoundUse deviceUse(const DebugMode& mode, const FramePair& pair) {
    const DeviceBounds bounds(mode, pair);
    return boundUse(pair.coverage, pair.baseline.channels.at(mode.channel).width,
                    [&](std::size_t i) { return pixelUse(bounds.error(i), bounds(i)); });
}

Tolerance deviceTolerance(const DebugMode& mode, const FramePair& pair, const BoundUse& use) {
    return {use.max, DeviceBounds(mode, pair).because()};
}

}  // namespace diptych
