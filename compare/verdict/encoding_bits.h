// SPDX-License-Identifier: MIT
// What the bits of a G-buffer's field allow the number in it to be off by, float32's evaluation included.
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/requirements.h"

#include <optional>
#include <span>

namespace diptych {

// Of a number in [0, 1], coded in `bits`: half a step.
double halfStep(unsigned bits);
double unormBound(unsigned bits);

// Of a number x in [0, 1] whose square root is coded: |(sqrt x + h)^2 - x|, h half a step. Worst where the
// last step meets 1, which squareBound() is.
double squareBound(double x, unsigned bits);
double squareBound(unsigned bits);

// Of radiance in 9.9.9.e5, of its largest component: relative to that, and the absolute least.
double radianceBound();
inline constexpr double leastRadianceBound = 0x1p-25;

// The largest angle in degrees that an octahedral normal of `bits` per coordinate can be off.
double octahedralBound(unsigned bits);

// How far a decoded unit vector's length may be from 1: float32's normalisation.
inline constexpr double lengthBound = 10 * 0x1p-24;

// How a field of Surface is stored in fewer bits than float32.
struct StoredField {
    enum class Code { unorm, root, octahedral, radiance };  // root: the square root of each component
    Code code;
    unsigned bits = 0;  // of each component or coordinate; radiance: of the mantissas

    double largestBound() const;  // of any value, in the channel's metric
};

// Of a channel of a G-buffer of this encoding; empty where it is stored exactly or not at all.
std::optional<StoredField> storedField(int mode, GBufferEncoding encoding, const Requirements& needs);

// The channels of all fields of Surface that lighting reads: lit is a function of them and of inputs that
// both paths share.
std::span<const int> lightingFields();

}  // namespace diptych
