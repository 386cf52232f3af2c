// SPDX-License-Identifier: MIT
// Quantization error bounds of G-buffer fields by number of bits, including float32 rounding.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/settings.h"
#include "shared/scene/requirements.h"

#include <optional>
#include <span>

namespace diptych {

// For a number in [0, 1] in `bits` bits: half a step.
double unormBound(unsigned bits);

// For a number x in [0, 1] whose square root is stored: |(sqrt x + h)^2 - x|, h half a step. Largest where
// the last step meets 1, which squareBound(bits) returns.
double squareBound(double x, unsigned bits);
double squareBound(unsigned bits);

// For values with an exponent: bound relative to the largest component, and the smallest absolute bound.
struct FloatBound {
    double relative, min;
};
FloatBound radianceBound(unsigned bits);  // of its mantissa
FloatBound halfBound(unsigned bits);      // without a sign

// For an index of refraction of at least 1: x = (n - 1) / (n + 1), 0 to 1, is stored in `bits` bits, whose
// code 0 is left free. Infinite where an error of half a step reaches x = 1.
double indexBound(double n, unsigned bits);

// Largest angle error of an octahedral normal with `bits` per coordinate, degrees.
double octahedralBound(unsigned bits);

// Largest angle between a line and the decoded one, degrees: stored as an angle in [0, pi) with `bits` in
// the plane perpendicular to a decoded octahedral normal with `normal_bits` per coordinate.
double lineBound(unsigned bits, unsigned normal_bits);

// Largest deviation of a decoded unit vector's length from 1: float32's normalisation.
inline constexpr double lengthBound = 10 * 0x1p-24;

// How a field of Surface is stored in fewer bits than float32.
struct StoredField {
    // root: the square root of each component; line: an angle, as for lineBound(); index: of refraction, as
    // for indexBound(); half: without its sign. Never exact.
    using Code = FieldCode;
    Code code;
    unsigned bits = 0;         // of each component or coordinate; radiance: of the mantissas
    unsigned normal_bits = 0;  // line: of each coordinate of the normal

    double largestBound() const;  // of any value, in the channel's error kind; index: infinite
};

// A channel's field in a G-buffer of this encoding; empty if it is stored exactly or not at all.
std::optional<StoredField> storedField(Channel channel, GBufferEncoding encoding, const Requirements& needs);

// The channels of all fields of Surface that lighting reads: lit is a function of them and of inputs that
// both paths share.
std::span<const Channel> lightingFields();

}  // namespace diptych
