// SPDX-License-Identifier: MIT
// How shaders read an environment: texels of four floats that say where its maps lie in their atlas, and the
// maps themselves, octahedral (Cigolle et al. 2014) with +Y in the middle.
#ifndef DIPTYCH_CONTRACT_ENVIRONMENT_H
#define DIPTYCH_CONTRACT_ENVIRONMENT_H

#include "types.h"

CONTRACT_BEGIN

// The feature `environment`, a sum; 0: nothing of an environment is read.
CONTRACT_CONST(uint, ENVIRONMENT_LIT, 1);          // irradiance by spherical harmonics, unless:
CONTRACT_CONST(uint, ENVIRONMENT_DIFFUSE_MAP, 2);  // by a map
CONTRACT_CONST(uint, ENVIRONMENT_SAMPLED, 4);      // the specular lobe by samples at every pixel

// The texels of BINDING_ENVIRONMENT:
//   0 to 2  rows of the rotation from world axes to the environment's; in w the factor on its radiance, the
//           number of levels, and the samples at a pixel
//   3 to 11 irradiance over pi, by ENVIRONMENT_HARMONICS coefficients of the polynomials
//           1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2 of the normal; W/(sr m^2)
//   12      the map of irradiance over pi: the corner of its nodes in the atlas, how many a side has; in w
//   --ibl-bias 13 ...  the levels, likewise
CONTRACT_CONST(uint, ENVIRONMENT_HARMONICS, 9);
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_HARMONICS, 3);
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_DIFFUSE, 12);
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_LEVELS, 13);

// Levels of the specular lobe: 0 is the environment itself, level i from 1 on is filtered for a GGX width of
// ENVIRONMENT_FIRST_ALPHA times 2^((i - 1) / ENVIRONMENT_LEVELS_AN_OCTAVE), the last one for 1. Between them
// radiance is linear in the level. With ENVIRONMENT_SAMPLED each level is instead the mean of four texels of
// the one before.
CONTRACT_CONST(uint, ENVIRONMENT_LEVELS_AN_OCTAVE, 2);
CONTRACT_CONST(float, ENVIRONMENT_FIRST_ALPHA, 0.015625f);
CONTRACT_CONST(uint, ENVIRONMENT_SPECULAR_LEVELS, 14);

CONTRACT_END

#endif
