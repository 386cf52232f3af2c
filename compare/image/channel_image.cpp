// SPDX-License-Identifier: MIT
#include "compare/image/channel_image.h"

#include "compare/image/heat.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace diptych {
namespace {

using Rgb8 = std::array<std::uint8_t, 3>;
using Color = std::array<float, 3>;

std::uint8_t byteOf(double zeroToOne) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(zeroToOne, 0.0, 1.0)));
}

// srgbFromLinear() in 8 bits, by a table over the square root, which resolves the steep dark end. With
// 4096 entries every code is off by at most one.
std::uint8_t srgbByte(float linear) {
    static const std::vector<std::uint8_t> table = [] {
        std::vector<std::uint8_t> codes(4097);
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const double root = static_cast<double>(i) / 4096;
            codes[i] = byteOf(srgbFromLinear(root * root));
        }
        return codes;
    }();
    return table[static_cast<std::size_t>(std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * 4096 + 0.5f)];
}

bool isRadiance(const DebugMode& mode) {
    if (mode.shown != ShownAs::by_metric) return mode.shown == ShownAs::radiance;
    return mode.kind == ChannelKind::color && mode.error_kind == ErrorKind::relative;
}
bool isNormalised(const DebugMode& mode) {
    if (mode.shown != ShownAs::by_metric) return mode.shown == ShownAs::normalised;
    return mode.channel == Channel::depth || mode.channel == Channel::position ||
           mode.channel == Channel::shaded_samples || mode.channel == Channel::iridescence_ior ||
           mode.channel == Channel::iridescence_thickness ||
           mode.channel == Channel::transmission_thickness || mode.channel == Channel::attenuation_distance ||
           mode.channel == Channel::dispersion || isHeat(mode);
}
// Unit of a normalised channel, after a space; empty if it has none.
const char* normalisedUnit(const DebugMode& mode) {
    if (mode.shown != ShownAs::by_metric || mode.channel == Channel::iridescence_ior ||
        mode.channel == Channel::dispersion)
        return "";
    return mode.channel == Channel::iridescence_thickness ? " nm" : " m";
}

Rgb8 display(Color radiance, const Exposure& exposure) {
    for (float& c : radiance) c = std::min(c * static_cast<float>(exposure.factor), 1e30f);
    if (exposure.tonemap) radiance = pbrNeutral(radiance);
    return {srgbByte(radiance[0]), srgbByte(radiance[1]), srgbByte(radiance[2])};
}

// Neighbouring ids get distant hues (steps of the golden angle) in three lightnesses.
Rgb8 idColor(float id) {
    const auto i = static_cast<std::int64_t>(id);
    const double hue = 6 * (0.6180339887498949 * static_cast<double>(i) + 0.07);
    const double value = i % 3 == 0 ? 0.95 : i % 3 == 1 ? 0.75 : 0.58;
    const auto channel = [&](double shift) {
        const double k = std::fmod(hue + shift, 6);
        return byteOf(value * (1 - 0.62 * std::clamp(std::min(k, 4 - k), 0.0, 1.0)));
    };
    return {channel(5), channel(3), channel(1)};
}

Rgb8 pixelColor(const DebugMode& mode, const float* p, const ImageScale& scale) {
    const auto normalised = [&](float v) {
        return byteOf((double{v} - scale.low) / (scale.high - scale.low));
    };
    if (isRadiance(mode)) return display({p[0], p[1], p[2]}, scale.exposure);
    if (isHeat(mode)) return heatColor(double{p[0]} / scale.high);
    if (mode.shown == ShownAs::display) return {byteOf(p[0]), byteOf(p[1]), byteOf(p[2])};
    switch (mode.kind) {
        case ChannelKind::color:
            return {srgbByte(p[0]), srgbByte(p[1]), srgbByte(p[2])};
        case ChannelKind::id:
            return idColor(p[0]);
        case ChannelKind::scalar:
            return {normalised(p[0]), normalised(p[0]), normalised(p[0])};
        case ChannelKind::vector:
            if (mode.width == 2) return {byteOf(p[0] - std::floor(p[0])), byteOf(p[1] - std::floor(p[1])), 0};
            return {normalised(p[0]), normalised(p[1]), normalised(p[2])};
    }
    return {};
}

void put(Image8& image, std::size_t pixel, const Rgb8& color) {
    std::copy(color.begin(), color.end(), image.data.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
}
Image8 blank(const Image& like) {
    return {like.width, like.height, 3, std::vector<std::uint8_t>(3 * like.pixels())};
}

}  // namespace

bool isHeat(const DebugMode& mode) {
    return mode.shown == ShownAs::by_metric && mode.channel == Channel::light_count;
}

double srgbFromLinear(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

std::array<float, 3> pbrNeutral(std::array<float, 3> rgb) {
    constexpr float f90 = 0.04f, start = 0.8f - f90, desaturation = 0.15f;
    const float min = std::min({rgb[0], rgb[1], rgb[2]});
    const float offset = min < 2 * f90 ? min - min * min / (4 * f90) : f90;
    for (float& c : rgb) c -= offset;
    const float peak = std::max({rgb[0], rgb[1], rgb[2]});
    if (peak < start) return rgb;
    const float room = 1 - start, newPeak = 1 - room * room / (peak + room - start);
    const float white = 1 - 1 / (desaturation * (peak - newPeak) + 1);
    for (float& c : rgb) c = std::lerp(c * newPeak / peak, newPeak, white);
    return rgb;
}

Exposure exposureFor(const ImageChoice& choice, const Image* lit, const Coverage& coverage) {
    if (choice.exposure)
        return {*choice.exposure, choice.tonemap, fmt::format("exposure {:.4g}, as set", *choice.exposure)};
    if (choice.ev100)
        return {1 / (1.2 * std::exp2(*choice.ev100)), choice.tonemap,
                fmt::format("EV100 {:.4g}", *choice.ev100)};
    std::vector<double> luminances;
    double sum = 0;
    for (std::size_t i = 0; lit && i < lit->pixels(); ++i) {
        const float* p = lit->pixel(i);
        const double y = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
        if (!coverage.covered[i] || !std::isfinite(y) || y < 0) continue;
        luminances.push_back(y);
        sum += y;
    }
    if (!(sum > 0)) return {1, choice.tonemap, "exposure 1: nothing is lit"};
    const auto count = static_cast<double>(luminances.size());
    double logs = 0;
    for (const double y : luminances) logs += std::log(std::max(y, 1e-3 * sum / count));
    const double average = std::exp(logs / count), byAverage = 0.18 / average;
    const auto p95 = luminances.begin() + static_cast<std::ptrdiff_t>(0.95 * (count - 1));
    std::nth_element(luminances.begin(), p95, luminances.end());
    const double byHighlights = 0.7 / *p95;
    if (*p95 > 0 && byHighlights < byAverage)
        return {byHighlights, choice.tonemap,
                fmt::format("exposure {:.4g}, automatic: 0.7 / 95th percentile of luminance {:.4g}",
                            byHighlights, *p95)};
    return {
        byAverage, choice.tonemap,
        fmt::format("exposure {:.4g}, automatic: 0.18 / log-average luminance {:.4g}", byAverage, average)};
}

ImageScale scaleFor(const DebugMode& mode, const Exposure& exposure, std::span<const Frame* const> frames) {
    if (isRadiance(mode))
        return {
            0, 1, exposure,
            exposure.because + (exposure.tonemap ? "; Khronos PBR Neutral, sRGB" : "; no tone curve, sRGB")};
    if (isNormalised(mode)) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Frame* frame : frames) {
            const Image& image = frame->channels.at(mode.channel);
            const Coverage seen = coverage(*frame, *frame);
            for (std::size_t i = 0; i < image.pixels(); ++i)
                for (int c = 0; seen.covered[i] && c < image.components; ++c)
                    if (const double v = image.pixel(i)[c]; std::isfinite(v)) {
                        low = std::min(low, v);
                        high = std::max(high, v);
                    }
        }
        if (!(low <= high)) low = high = 0;
        if (isHeat(mode))
            return {0, heatTop(high), exposure, fmt::format("heat map, 0 to {:g} lights", heatTop(high))};
        if (mode.channel == Channel::shaded_samples)
            return {0, std::max(high, 1.0), exposure, fmt::format("grey, 0 to {:g} per pixel", high)};
        const std::string range = fmt::format("{:.4g} to {:.4g}{}", low, high, normalisedUnit(mode));
        if (low == high) high = low + 1;
        return {low, high, exposure, (mode.width == 1 ? "grey, " : "x, y, z as red, green, blue, ") + range};
    }
    if (mode.shown == ShownAs::display) return {0, 1, exposure, "as stored"};
    switch (mode.kind) {
        case ChannelKind::color:
            return {0, 1, exposure, "sRGB, no exposure"};
        case ChannelKind::id:
            return {0, 1, exposure, "a hue per index"};
        case ChannelKind::scalar:
            return {0, 1, exposure, "grey, 0 to 1"};
        case ChannelKind::vector:
            if (mode.width == 2) return {0, 1, exposure, "u red, v green, wrapped to 0 to 1"};
            return {-1, 1, exposure, "x, y, z as red, green, blue, -1 to 1"};
    }
    return {};
}

Image8 channelImage(const DebugMode& mode, const Frame& frame, const ImageScale& scale) {
    const Image& image = frame.channels.at(mode.channel);
    const Coverage seen = coverage(frame, frame);
    const Rgb8 background = mode.channel == Channel::lit ? display(frame.background, scale.exposure) : Rgb8{};
    Image8 result = blank(image);
    const auto found = frame.repaired.find(mode.channel);
    const std::span<const std::uint32_t> repaired =
        found == frame.repaired.end() ? std::span<const std::uint32_t>() : std::span(found->second);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* p = image.pixel(i);
        if (std::ranges::binary_search(repaired, static_cast<std::uint32_t>(i))) {
            put(result, i, nonfiniteColor);
            continue;
        }
        // Background: the environment, if the frame shows one.
        if (!seen.covered[i] && (mode.channel != Channel::lit ||
                                 std::all_of(p, p + image.components, [](float v) { return v == 0; })))
            put(result, i, background);
        else if (!std::all_of(p, p + image.components, [](float v) { return std::isfinite(v); }))
            put(result, i, nonfiniteColor);
        else
            put(result, i, pixelColor(mode, p, scale));
    }
    return result;
}

std::array<std::uint8_t, 3> errorColor(double t) {
    t = std::clamp(t, 0.0, 1.0);
    const double lightness = 0.22 + 0.75 * t, chroma = 0.19 * std::sin(std::numbers::pi * (0.12 + 0.85 * t));
    const double hue = (300 + 165 * t) * std::numbers::pi / 180;  // violet 300, red 30, yellow 105 degrees
    const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
    const auto cube = [](double v) { return v * v * v; };
    const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b),
                 m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b),
                 s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    return {byteOf(srgbFromLinear(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
            byteOf(srgbFromLinear(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
            byteOf(srgbFromLinear(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s))};
}

namespace {

constexpr int beyondShades = 9;

// From beyondColor just above the top to white at farBeyond times the top, in equal logarithmic steps.
Rgb8 beyondShade(double times) {
    const double fraction = std::min(std::log(times) / std::log(farBeyond), 1.0);
    const double t = std::min(std::floor(fraction * beyondShades), beyondShades - 1.0) / (beyondShades - 1);
    Rgb8 color{};
    for (std::size_t c = 0; c < color.size(); ++c)
        color[c] =
            static_cast<std::uint8_t>(std::lround(std::lerp(static_cast<double>(beyondColor[c]), 255.0, t)));
    return color;
}

}  // namespace

Image8 errorMap(const Image& errors, double top) {
    // With black, the shades beyond the top and the colour of infinity, a palette has 256 colours.
    static const std::array<Rgb8, 254 - beyondShades> map = [] {
        std::array<Rgb8, 254 - beyondShades> colors;
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = errorColor(static_cast<double>(i) / (colors.size() - 1));
        return colors;
    }();
    Image8 result = blank(errors);
    for (std::size_t i = 0; i < errors.pixels(); ++i) {
        const double e = errors.data[i];
        if (!std::isfinite(e))
            put(result, i, nonfiniteColor);
        else if (e > top * (1 + 1e-6))  // an error image is float32, its top a double
            put(result, i, beyondShade(e / top));
        else if (e > 0)
            put(result, i,
                map[static_cast<std::size_t>(
                    std::lround((map.size() - 1) * std::sqrt(std::min(e / top, 1.0))))]);
    }
    return result;
}

Image8 halfSize(const Image8& image) {
    const auto n = static_cast<std::size_t>(image.components), width = static_cast<std::size_t>(image.width),
               height = static_cast<std::size_t>(image.height);
    const std::size_t halfWidth = std::max<std::size_t>(width / 2, 1),
                      halfHeight = std::max<std::size_t>(height / 2, 1);
    Image8 result{static_cast<int>(halfWidth), static_cast<int>(halfHeight), image.components, {}};
    result.data.reserve(halfWidth * halfHeight * n);
    for (std::size_t y = 0; y < halfHeight; ++y)
        for (std::size_t x = 0; x < halfWidth; ++x)
            for (std::size_t c = 0; c < n; ++c) {
                unsigned sum = 2;
                for (const std::size_t row : {2 * y, std::min(2 * y + 1, height - 1)})
                    for (const std::size_t column : {2 * x, std::min(2 * x + 1, width - 1)})
                        sum += image.data[(row * width + column) * n + c];
                result.data.push_back(static_cast<std::uint8_t>(sum / 4));
            }
    return result;
}

}  // namespace diptych
