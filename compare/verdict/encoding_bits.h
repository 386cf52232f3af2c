// SPDX-License-Identifier: MIT
// Quantization error bounds of G-buffer fields by number of bits, including float32 rounding.
#pragma once

namespace diptych {

// For a number in [0, 1] in `bits` bits: half a step.
double halfStep(unsigned bits);
double unormBound(unsigned bits);

// For a number x in [0, 1] whose square root is stored: |(sqrt x + h)^2 - x|, h half a step. Largest where
// the last step meets 1, which squareBound(bits) returns.
double squareBound(double x, unsigned bits);
double squareBound(unsigned bits);

// For radiance in 9.9.9.e5: bound relative to its largest component, and the smallest absolute bound.
double radianceBound();
inline constexpr double leastRadianceBound = 0x1p-25;

// Largest angle error of an octahedral normal with `bits` per coordinate, degrees.
double octahedralBound(unsigned bits);

// Largest deviation of a decoded unit vector's length from 1: float32's normalisation.
inline constexpr double lengthBound = 10 * 0x1p-24;

}  // namespace diptych
