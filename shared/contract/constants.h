// SPDX-License-Identifier: MIT
// Pi, and every limit that affects a pixel.
#ifndef DIPTYCH_CONTRACT_CONSTANTS_H
#define DIPTYCH_CONTRACT_CONSTANTS_H

#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(float, PI, 3.14159265358979323846f);
CONTRACT_CONST(float, INVERSE_PI, 0.31830988618379067154f);

// Smallest perceptual roughness that is shaded: on a perfect mirror, a punctual light's highlight is a
// delta. Filament uses the same 0.045 on desktops.
CONTRACT_CONST(float, MIN_PERCEPTUAL_ROUGHNESS, 0.045f);

// Smallest n.v that is shaded: a normal map may turn the normal of a visible surface away from the viewer.
CONTRACT_CONST(float, MIN_N_DOT_V, 1e-4f);

// Smallest squared distance to a light, m^2 (0.1 nm): keeps a surface point at the light's centre finite.
CONTRACT_CONST(float, MIN_LIGHT_DISTANCE_SQUARED, 1e-20f);

// F0 of a dielectric with the default index of refraction 1.5: ((1.5 - 1) / (1.5 + 1))^2.
CONTRACT_CONST(float, DEFAULT_DIELECTRIC_F0, 0.04f);

// Texture coordinates are clamped to +-this before and after their transform. From 2^24 on they have no
// fraction to select a texel; infinite ones return NaN.
CONTRACT_CONST(float, MAX_TEXCOORD, 1e9f);

CONTRACT_END

#endif
