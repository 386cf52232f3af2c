// SPDX-License-Identifier: MIT
// The sun of an environment, taken out of its picture as a directional light.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

#include <string>

namespace diptych {

// What a spot must be to be taken for a sun.
namespace sun_spot {

// It is as bright as this many times the mean radiance, at least, in every texel.
inline constexpr double leastContrast = 16;
// It is no larger than a disc of 6.5 degrees, sr; a spot that is surrounded by more as bright as that ends
// higher, where what is above is that small, but at an eighth of its peak at the latest.
inline constexpr double largestSolidAngle = 0.01;
inline constexpr double leastFall = 8;
// It is compact: of its radiance, summed over all directions, a surface that faces it gets this share, at
// least (of a disc of 6.5 degrees 0.9992), and what such a surface lacks is at most this share of all the
// light.
inline constexpr double leastFacing = 0.998;
inline constexpr double mostLost = 1e-3;
// Its share of the light from all directions.
inline constexpr double leastShare = 0.002;

}  // namespace sun_spot

struct EnvironmentSun {
    bool found = false;
    std::string why;  // not found: the reason, in words

    // The environment with what lies around the spot (the median of the texels within two steps, by
    // component, where it is less) in the spot's place.
    Environment residual;
    // In the environment's own axes; its direction is the mean of what was taken out, weighted by luminance,
    // its illuminance, by component, what falls on a surface that faces it, and its angle that of an even
    // disc which has this illuminance and this mean of the squared radiance.
    Light light;
    double share = 0;  // of the luminance of the light from all directions
};

// The spot of the most luminance that is as described above. The integrals are of the bilinear picture that
// scene.h describes, in double.
EnvironmentSun environmentSun(const Environment& environment);

// The light in world axes, of an environment that is turned about +Y, counter-clockwise seen from above,
// degrees, and whose radiance is multiplied by `factor`.
Light turnedSun(const Light& light, double degrees, double factor);

// "of 0.53 degrees, towards (0.3, 0.8, 0.5), 12.4 (10.1, 9.2, 8.1) lux, 63 % of the environment's light", of
// a light of turnedSun().
std::string inWords(const Light& sun, double share);

}  // namespace diptych
