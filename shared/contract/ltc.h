// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_LTC_H
#define DIPTYCH_CONTRACT_LTC_H

#include "types.h"

CONTRACT_BEGIN

// The table of linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time Polygonal-Light
// Shading with Linearly Transformed Cosines"): cell (i, j) of LTC_CELLS x LTC_CELLS is a specular lobe of
//     roughness = mix(MIN_PERCEPTUAL_ROUGHNESS, 1, i / (LTC_CELLS - 1)),   alpha = roughness^2
//     n.v       = (1 - j / (LTC_CELLS - 1))^2
// In the frame z = n, x = away from the viewer along the surface, a direction of the clamped cosine becomes
// one of the lobe by
//         | a 0 b |      a = in_plane 2 alpha / m^2        m^2 = (n.v)^2 + (alpha sin)^2
//     M = | 0 c 0 |      c = across   2 alpha              sin^2 = 1 - (n.v)^2
//         | 0 0 1 |      b = (1 - unsheared) sin / m
// The factors of the three are what a mirror's lobe has: in_plane and across go to 1, unsheared to 0, and all
// vary slowly in between, with n.v near the normal and its root where the view grazes. The last row keeps the
// horizon where it is: no light from below it arrives, and one clipping of a light serves both lobes. The
// paper's fourth entry, which does not, would halve the error of smooth surfaces seen at an angle, and change
// that of rough or grazing ones by less than a fifth.
CONTRACT_CONST(uint, LTC_CELLS, 64);

CONTRACT_END

#endif
