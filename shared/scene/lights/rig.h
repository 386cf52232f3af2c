// SPDX-License-Identifier: MIT
// Generated lights: rigs and the default sun.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/bounds.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// The uint32 hash of builtin:spheres: PCG's output permutation over one LCG step (O'Neill 2014, "PCG: A
// Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number Generation";
// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering"). u01(i) = pcg(i) / 2^32 in double.
std::uint32_t pcg(std::uint32_t i);
double u01(std::uint32_t i);

// Estimated memory of one light with its copies on a CPU device, measured (scene/MEASURED.md).
inline constexpr double lightBytes = 500;

// World-space lights from `lights`, the value of Settings::lights. This is a JSON file { "lights": [...] }
// (it ends in .json or exists), or "KIND:N[,KIND:N...]": N lights of KIND (point, spot or area) scattered
// in `bounds`. If a kind is repeated, its numbering continues. Position, colour and direction of light i
// do not depend on N; range and intensity follow from the density of all N lights:
//
//   box      the bounds, each side enlarged to at least an eighth of the longest: x and z about the
//            middle, y upwards. A point becomes 1 m a side, empty bounds 2 m about the origin.
//   key      pcg(seed + pcg(kind)), kind 0 point, 1 spot, 2 area;  u(i, k) = u01(pcg(key + i) + k)
//   position box at frac(u01(key + k) + (i + 1) / g^k), k = 1, 2, 3, g^4 = g + 1: the R3 sequence (Roberts
//            2018, "The Unreasonable Effectiveness of Quasirandom Sequences"); spot and area lights only
//            in the upper half
//   colour   the hue u(i, 0) mixed with white, 0.6 : 0.4, largest component 1
//   range    (6 * 3/(4 pi) * volume / N)^(1/3): 6 point lights reach a point far from the sides; doubled
//            for spot lights, because a cone covers about an eighth of a sphere
//   candela  0.4 range^2 / luminance(colour), with a point light's range: all lights are equally bright,
//            and the mean irradiance is about 1.5 lux for any size and N
//   spots    down, tilted by 35 degrees * sqrt(u(i, 1)) towards the azimuth 2 pi u(i, 2); outer cone 20 to
//            40 degrees by u(i, 3), inner cone 0.7 of it
//   area     rectangles, discs and tubes, a third each by u(i, 3), with a point light's range. They point
//            down like spot lights; the axis is perpendicular, rotated by u(i, 4). As fractions of the
//            range: rectangles 0.2 to 0.5 wide, by u(i, 5), and 0.25 to 1 of that high, by u(i, 6); discs
//            0.1 to 0.25 in radius; tubes 0.3 to 0.7 long and 0.01 to 0.05 of that in radius. Nits are the
//            candela divided by the area seen from the front, so that distant area lights match the others
//
// Throws std::runtime_error: one line with --lights or the file, the fault and the accepted values. N is
// limited by memory (rigBytes() must be free) and, over all kinds together, by 2^31.
std::vector<Light> makeLights(const std::string& lights, std::uint32_t seed, const Bounds& bounds);

// Estimated memory of the lights; 0 for a file.
std::uint64_t rigBytes(const std::string& lights);

// A sun of 3 lux for scenes without lights and environment: a white Lambertian surface that faces it has
// radiance 0.95. It is behind the viewer, higher and to the left, so that shapes do not look flat. The
// direction towards it is normalize(e + 0.9 up + 0.35 left), with e the unit direction towards the eye.
// The default e is that of the default view.
Light defaultSun(const glm::dvec3& towardsEye = {1, 0.6, 1});

}  // namespace diptych
