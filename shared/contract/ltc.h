// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_LTC_H
#define DIPTYCH_CONTRACT_LTC_H

#include "types.h"

CONTRACT_BEGIN

// Table of linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time Polygonal-Light
// Shading with Linearly Transformed Cosines"). Cell (i, j) of LTC_CELLS x LTC_CELLS is a specular lobe
// with
//     roughness = mix(MIN_PERCEPTUAL_ROUGHNESS, 1, i / (LTC_CELLS - 1)),   alpha = roughness^2
//     n.v       = (1 - j / (LTC_CELLS - 1))^2
// The frame has z = n, and x along the surface away from the viewer. M transforms a direction of the
// clamped cosine to one of the lobe:
//         | a 0 b |      a = in_plane 2 alpha / m^2        m^2 = (n.v)^2 + (alpha sin)^2
//     M = | 0 c 0 |      c = across   2 alpha              sin^2 = 1 - (n.v)^2
//         | 0 0 1 |      b = (1 - unsheared) sin / m
// The table stores in_plane, across and unsheared relative to a mirror's lobe: for a mirror they are 1, 1
// and 0. They vary slowly, with n.v near the normal and with its root at grazing angles. The last row of M
// preserves the horizon: no light arrives from below, and one clipped polygon serves both lobes.
//
// The paper's fourth entry would rotate the horizon. Instead the cosine has a tilt k: the density of a
// direction p (unit, in the cosine's frame) is (p.z + k p.x) / pi, whose integral over the hemisphere is
// still 1. Lambert's contour integral yields all three components of the light's vector, so the tilt costs
// one product. The density is negative where p.x < -p.z / k, for at most 3 % of the total.
//
// Each cell has two fitted lobes: "even" with F = 1, and "layer" with Schlick's F from LTC_LAYER_F0 to 1,
// as on a dielectric layer. Their shapes differ because the layer reflects mostly at grazing angles. Other
// lobes interpolate the parameters.
CONTRACT_CONST(uint, LTC_CELLS, 64);
// Blocks of LTC_CELLS rows in the texture: even (in_plane, across, unsheared, tilt), layer (the same), and
// (magnitude, fresnel, 0, 0).
CONTRACT_CONST(uint, LTC_BLOCKS, 3);
CONTRACT_CONST(float, LTC_LAYER_F0, 0.04f);

CONTRACT_END

#endif
