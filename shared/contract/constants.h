// SPDX-License-Identifier: MIT
// The one home of pi and of every limit that changes a pixel.
#ifndef DIPTYCH_CONTRACT_CONSTANTS_H
#define DIPTYCH_CONTRACT_CONSTANTS_H

#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(float, PI, 3.14159265358979323846f);
CONTRACT_CONST(float, INVERSE_PI, 0.31830988618379067154f);

// Smallest perceptual roughness that is shaded. A punctual light on a perfect mirror is a delta that no
// sample finds; 0.045 is Filament's figure, the smallest whose alpha^2 survives half precision.
CONTRACT_CONST(float, MIN_PERCEPTUAL_ROUGHNESS, 0.045f);

// Smallest n.v that is shaded: a normal-mapped surface may face away from the viewer that sees it.
CONTRACT_CONST(float, MIN_N_DOT_V, 1e-4f);

// Smallest squared distance to a light, m^2 (a tenth of a nanometre): a surface point in the light's own
// centre stays finite, and nothing that a scene in metres can hold is touched.
CONTRACT_CONST(float, MIN_LIGHT_DISTANCE_SQUARED, 1e-20f);

// F0 of a dielectric with the default index of refraction 1.5: ((1.5 - 1) / (1.5 + 1))^2.
CONTRACT_CONST(float, DEFAULT_DIELECTRIC_F0, 0.04f);

// Texture coordinates are kept within this, before and after their transform: from 2^24 on they have no
// fraction left to choose a texel by, and infinite ones give texels that are not numbers.
CONTRACT_CONST(float, MAX_TEXCOORD, 1e9f);

CONTRACT_END

#endif
