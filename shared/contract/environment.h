// SPDX-License-Identifier: MIT
// How shaders read an environment: texels of four floats that locate its maps in their atlas, and the
// maps. The maps are octahedral (Cigolle et al. 2014) with +Y in the centre.
#ifndef DIPTYCH_CONTRACT_ENVIRONMENT_H
#define DIPTYCH_CONTRACT_ENVIRONMENT_H

#include "types.h"

CONTRACT_BEGIN

// FEATURE_environment, a sum; 0: no environment.
CONTRACT_CONST(uint, ENVIRONMENT_LIT, 1);          // irradiance from spherical harmonics, unless:
CONTRACT_CONST(uint, ENVIRONMENT_DIFFUSE_MAP, 2);  // irradiance from a map
CONTRACT_CONST(uint, ENVIRONMENT_SAMPLED, 4);      // specular lobe sampled at every pixel

// Texels of BINDING_ENVIRONMENT:
//   0       cosine and sine of the rotation about +Y, radiance factor, number of levels
//   1 to 7  irradiance / pi, W/(sr m^2): nine coefficients of the polynomials 1, y, z, x, xy, yz,
//           3 z^2 - 1, xz, x^2 - y^2 of the world-space normal. rgb: the first seven coefficients;
//           w: the three components of the eighth, then of the ninth
//   8       map of irradiance / pi: corner of its nodes in the atlas, nodes per side; w: --ibl-bias
//   9 ...   levels, in the same form; w of the first: samples per pixel
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_HARMONICS, 1);
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_DIFFUSE, 8);
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_LEVELS, 9);

// Levels of the specular lobe. Level 0 is the environment itself. Level i >= 1 is filtered with a GGX
// alpha of ENVIRONMENT_FIRST_ALPHA * 2^((i - 1) / ENVIRONMENT_LEVELS_AN_OCTAVE); the last has alpha 1.
// Radiance is interpolated linearly in the level.
// With ENVIRONMENT_SAMPLED each level is instead a 2x2 box filter of the previous one.
CONTRACT_CONST(uint, ENVIRONMENT_LEVELS_AN_OCTAVE, 2);
CONTRACT_CONST(float, ENVIRONMENT_FIRST_ALPHA, 0.015625f);
CONTRACT_CONST(uint, ENVIRONMENT_SPECULAR_LEVELS, 14);

CONTRACT_END

#endif
