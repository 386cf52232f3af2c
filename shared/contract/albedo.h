// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_ALBEDO_H
#define DIPTYCH_CONTRACT_ALBEDO_H

#include "types.h"

CONTRACT_BEGIN

// Directional albedo of the specular lobe: f0 * t.x + f90 * t.y. t depends on n.v and GGX's alpha alone
// (Karis 2013, "Real Shading in Unreal Engine 4": the environment BRDF). The table has HEIGHT rows of
// WIDTH samples.
// clang-format off
//   along a row    x = ALBEDO_BLEND * sqrt(n.v (1 + k) / (n.v + k)) + (1 - ALBEDO_BLEND) * sqrt(n.v),
//                  k = 2 alpha: at grazing angles the transition is as wide as alpha
//   across rows    y = sqrt(roughness), from the smallest shaded roughness to 1
// clang-format on
// Interpolation is cubic: Lagrange's polynomial through the four nearest samples, at the border through
// the last four. The error against the integral is at most 6e-5.
CONTRACT_CONST(uint, ALBEDO_TABLE_WIDTH, 96);
CONTRACT_CONST(uint, ALBEDO_TABLE_HEIGHT, 48);
CONTRACT_CONST(float, ALBEDO_BLEND, 0.3f);

// Directional albedo of a sheen (shaders/lib/shading/sheen.glsl), after the table above: SIZE x SIZE samples
// of E(n.v) (1 + Lambda(n.v)) 4 n.v, which is smooth where E is not; each texel stores four along its row.
// clang-format off
//   along a row    x = (sqrt(n.v (1 + k) / (n.v + k)) + sqrt(n.v)) / 2, k = SHEEN_TABLE_WIDENS * roughness
//   across rows    y = fourth root of roughness, from the smallest shaded roughness to 1
// clang-format on
// Interpolation is cubic as above. The error of E is at most 1.1e-4 from n.v = 0.01, and 5e-3 below.
CONTRACT_CONST(uint, SHEEN_TABLE_FIRST, ALBEDO_TABLE_WIDTH* ALBEDO_TABLE_HEIGHT);
CONTRACT_CONST(uint, SHEEN_TABLE_SIZE, 32);
CONTRACT_CONST(float, SHEEN_TABLE_WIDENS, 2.0f);

CONTRACT_END

#endif
