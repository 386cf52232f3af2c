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
// The factors of a, b and c are what a mirror's lobe has: in_plane and across go to 1, unsheared to 0, and
// all vary slowly in between, with n.v near the normal and its root where the view grazes. The last row keeps
// the horizon where it is: no light from below it arrives, and one clipping of a light serves both lobes.
//
// Instead of the paper's fourth entry, which would turn the horizon, the cosine has a tilt k: the density of
// a direction p (unit, in the cosine's frame) is (p.z + k p.x) / pi, which over the hemisphere still sums to
// 1. Lambert's contour gives all three components of the light's vector, so that the tilt costs a product.
// The density is negative where p.x < -p.z / k, by at most three hundredths of the whole.
//
// Two lobes are fitted to each cell: "even", with F = 1, and "layer", with Schlick's F from LTC_LAYER_F0 to
// 1, as a dielectric's layer has it: slanted views see mostly what glances off it, and the shape of that is
// another. A lobe in between has parameters in between.
CONTRACT_CONST(uint, LTC_CELLS, 64);
// Above one another in the texture, LTC_CELLS rows each: even and layer, both (in_plane, across, unsheared,
// tilt); (magnitude, fresnel, 0, 0).
CONTRACT_CONST(uint, LTC_BLOCKS, 3);
CONTRACT_CONST(float, LTC_LAYER_F0, 0.04f);

CONTRACT_END

#endif
