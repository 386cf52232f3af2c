// SPDX-License-Identifier: MIT
#include "compare/verdict/encoding_bits.h"

#include "shared/contract/debug_mode.h"
#include "shared/contract/gbuffer.h"
#include "shared/contract/surface_channels.h"
#include "shared/material/gbuffer_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace diptych {
namespace {

// float32 error of a number in [0, 1] through packUnorm and unpackUnorm: a product and a sum (half an ULP
// of 1 each) and a division (2.5 ULP in Vulkan), doubled for a square root and a square.
constexpr double unormSlack = 8 * 0x1p-24;
constexpr double squareSlack = 2 * unormSlack;

// float32 error of x = (n - 1) / (n + 1): 7 units of 2^-24 of it to encode (two sums and a division), 9 to
// scale, round and decode it; and of (1 + x) / (1 - x) from x, relative: two sums, a division, doubled.
constexpr double indexSlack = 16 * 0x1p-24, indexFraction = 14 * 0x1p-24;

// float32 error of the angle's polynomial (shaders/lib/math/angles.glsl, relative 6e-7), of sine and cosine,
// and of the plane's axes, radians. Vulkan permits a sine 2^-11 off; lavapipe stays within this.
constexpr double lineSlack = 0x1p-18;

unsigned bitsOf(const ChannelCode& stored, GBufferEncoding packed) {
    return packed == GBufferEncoding::compact ? stored.compact : stored.standard;
}

// Whether a packed G-buffer of the scene has the channel in fewer bits than float32.
bool isQuantised(Channel channel, GBufferEncoding encoding, const Requirements& needs) {
    const GBufferLayout layout = gbufferLayout(encoding, needs);
    switch (sourceOf(channel).part) {
        case MaterialPart::none:
            return true;
        case MaterialPart::emission:
            return needs.emission && !layout.wide_emission;
        case MaterialPart::lightmap:
            return needs.lightmap && !layout.wide_lightmap;
        case MaterialPart::dielectric:
            return needs.dielectric_specular;
        default:
            return (needs.surface_layers & layerOf(channel)) != 0;
    }
}

double halfStep(unsigned bits) {
    return 0.5 / static_cast<double>((1u << bits) - 1);
}

}  // namespace

double unormBound(unsigned bits) {
    return halfStep(bits) + unormSlack;
}

double squareBound(double x, unsigned bits) {
    const double h = halfStep(bits);
    return h * (2 * std::sqrt(x) + h) + squareSlack;
}

double squareBound(unsigned bits) {
    const double h = halfStep(bits);
    return 2 * h - h * h + squareSlack;
}

// The largest component's top bit is set, so of 9 bits half a step is at most 0.5 / 256 of it, plus 1/512 of
// that if rounding changes the exponent. Below 2^-16 the exponent is at its minimum and half a step stays
// 2^-25.
FloatBound radianceBound(unsigned bits) {
    const double step = std::ldexp(1.0, -static_cast<int>(bits));
    return {step * (1 + step), std::ldexp(0.5 * step, -static_cast<int>(gpu::EMISSION_BIAS))};
}

FloatBound halfBound(unsigned bits) {
    const double relative =
        std::ldexp(0.5, static_cast<int>(gpu::HALF_EXPONENT_BITS) - static_cast<int>(bits));
    return {relative, relative * 0x1p-14};
}

// n = (1 + x) / (1 - x), so x + h decodes to n + 2h / ((1 - x) (1 - x - h)), where 1 - x = 2 / (n + 1). The
// error of x - h is smaller. One code fewer than all counts, because code 0 is free.
double indexBound(double n, unsigned bits) {
    const double h = 0.5 / static_cast<double>((1u << bits) - 2) + indexSlack, rest = 2 / (n + 1);
    return rest > h ? 2 * h / (rest * (rest - h)) + indexFraction * n
                    : std::numeric_limits<double>::infinity();
}

// Rounding moves a point of the octahedron |x|+|y|+|z| = 1 by up to (h, h, -2h), h = 0.5 / (2^(bits-1) -
// 1). At a face's centre, 1 / sqrt(3) from the origin, that is perpendicular to the direction: an angle of
// sqrt(6) h sqrt(3) = 3 sqrt(2) h. float32 adds some 8 roundings of 2^-24 to the coordinates before
// quantization, and 10 to the decoded, normalised vector.
double octahedralBound(unsigned bits) {
    const double h = 0.5 / static_cast<double>((1u << (bits - 1)) - 1);
    return 180 / std::numbers::pi * (3 * std::numbers::sqrt2 * (h + 8 * 0x1p-24) + lengthBound);
}

// The stored angle is that of the projection p of the unit direction d onto the plane perpendicular to the
// decoded normal n'. The angle between d and p has the sine |d.n'|. Since d.n = 0 for the own normal n, that
// is |d.(n' - (n.n') n)|, and the vector in brackets has the length sin(n, n'). So that angle is at most the
// one between the normals. Half a step, pi / 2^(bits + 1), turns p within the plane, perpendicular to the arc
// from d. The hypotenuse of a right triangle on a sphere is at most that of a flat one.
double lineBound(unsigned bits, unsigned normal_bits) {
    return std::hypot(octahedralBound(normal_bits), 180 * std::ldexp(0.5, -static_cast<int>(bits))) +
           180 / std::numbers::pi * lineSlack;
}

double StoredField::largestBound() const {
    switch (code) {
        case Code::exact:
            return 0;
        case Code::unorm:
            return unormBound(bits);
        case Code::root:
            return squareBound(bits);
        case Code::octahedral:
            return octahedralBound(bits);
        case Code::line:
            return lineBound(bits, normal_bits);
        case Code::radiance:
            return radianceBound(bits).relative;
        case Code::index:
            return std::numeric_limits<double>::infinity();
        case Code::half:
            return halfBound(bits).relative;
    }
    return 0;
}

std::optional<StoredField> storedField(Channel channel, GBufferEncoding encoding, const Requirements& needs) {
    if (encoding == GBufferEncoding::full) return {};
    const ChannelCode& stored = debugMode(channel).stored;
    if (stored.code == FieldCode::exact || !isQuantised(channel, encoding, needs)) return {};
    StoredField field{stored.code, bitsOf(stored, encoding)};
    if (field.code == FieldCode::line)
        field.normal_bits = bitsOf(debugMode(Channel::normals).stored, encoding);
    return field;
}

std::span<const Channel> lightingFields() {
    static const std::vector<Channel> fields = [] {
        // The fourth component of the lightmap's image.
        std::vector<Channel> found{Channel::lightmapped};
#define DIPTYCH_LIGHTING_FIELD(binding, name) found.push_back(Channel::name);
        SURFACE_CHANNELS(DIPTYCH_LIGHTING_FIELD)
#undef DIPTYCH_LIGHTING_FIELD
        std::ranges::sort(found);
        return found;
    }();
    return fields;
}

}  // namespace diptych
