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
//   0       cosine and sine of its turn about +Y, the factor on its radiance, the number of levels
//   1 to 7  irradiance over pi, W/(sr m^2), by nine coefficients of the polynomials 1, y, z, x, xy, yz,
//           3 z^2 - 1, xz, x^2 - y^2 of the normal in world axes: in rgb the first seven, in w the three
//           components of the eighth, then those of the ninth
//   8       the map of irradiance over pi: the corner of its nodes in the atlas, how many a side has; in w
//           --ibl-bias
//   9 ...   the levels, likewise; in the first one's w the samples at a pixel
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_HARMONICS, 1);
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_DIFFUSE, 8);
CONTRACT_CONST(uint, ENVIRONMENT_TEXEL_LEVELS, 9);

// Levels of the specular lobe: 0 is the environment itself, level i from 1 on is filtered for a GGX width of
// ENVIRONMENT_FIRST_ALPHA times 2^((i - 1) / ENVIRONMENT_LEVELS_AN_OCTAVE), the last one for 1. Between them
// radiance is linear in the level. With ENVIRONMENT_SAMPLED each level is instead the mean of four texels of
// the one before.
CONTRACT_CONST(uint, ENVIRONMENT_LEVELS_AN_OCTAVE, 2);
CONTRACT_CONST(float, ENVIRONMENT_FIRST_ALPHA, 0.015625f);
CONTRACT_CONST(uint, ENVIRONMENT_SPECULAR_LEVELS, 14);

CONTRACT_END

#endif
