// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_ALBEDO_H
#define DIPTYCH_CONTRACT_ALBEDO_H

#include "types.h"

CONTRACT_BEGIN

// Directional albedo of the specular lobe: f0 * t.x + f90 * t.y. t depends on n.v and GGX's alpha alone
// (Karis 2013, "Real Shading in Unreal Engine 4": the environment BRDF). The table has HEIGHT rows of
// WIDTH samples.
// clang-format off
//   along a row    x = ALBEDO_BLEND * sqrt(n.v (1 + k) / (n.v + k)) + (1 - ALBEDO_BLEND) * sqrt(n.v), k = 2 alpha:
//                  at grazing angles the transition is as wide as alpha
//   across rows    y = sqrt(roughness), from the smallest shaded roughness to 1
// clang-format on
// Interpolation is cubic: Lagrange's polynomial through the four nearest samples, at the border through
// the last four. The error against the integral is at most 6e-5.
CONTRACT_CONST(uint, ALBEDO_TABLE_WIDTH, 96);
CONTRACT_CONST(uint, ALBEDO_TABLE_HEIGHT, 48);
CONTRACT_CONST(float, ALBEDO_BLEND, 0.3f);

CONTRACT_END

#endif
