// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_ALBEDO_H
#define DIPTYCH_CONTRACT_ALBEDO_H

#include "types.h"

CONTRACT_BEGIN

// What the specular lobe reflects of light that is the same from everywhere: f0 * t.x + f90 * t.y, t a
// function of n.v and GGX's alpha alone (Karis 2013, "Real Shading in Unreal Engine 4": the environment
// BRDF). HEIGHT rows of WIDTH samples.
// clang-format off
//   along a row    x = ALBEDO_BLEND * sqrt(n.v (1 + k) / (n.v + k)) + (1 - ALBEDO_BLEND) * sqrt(n.v), k = 2 alpha:
//                  the edge of a lobe at grazing angles is as wide as alpha
//   across rows    y = sqrt(roughness), from the least that is shaded to 1
// clang-format on
// Between samples it is cubic: Lagrange's polynomial through the nearest four, at the rim through the last
// four. Within 6e-5 of the integral everywhere.
CONTRACT_CONST(uint, ALBEDO_TABLE_WIDTH, 96);
CONTRACT_CONST(uint, ALBEDO_TABLE_HEIGHT, 48);
CONTRACT_CONST(float, ALBEDO_BLEND, 0.3f);

CONTRACT_END

#endif
