// SPDX-License-Identifier: MIT
// Extracts the sun from an environment map as a directional light.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

#include <string>

namespace diptych {

// Criteria for a spot to count as a sun.
namespace sun_spot {

// Least brightness of each texel, relative to the mean radiance.
inline constexpr double minContrast = 16;
// Largest solid angle, sr: a disc of 6.5 degrees. If a spot is part of a larger bright region, its
// boundary level is raised until it is small enough. The level must stay at or below 1 / minFall of the
// peak.
inline constexpr double largestSolidAngle = 0.01;
inline constexpr double minFall = 8;
// Compactness: a surface that faces the spot receives at least minFacing of its light (0.9992 for a disc
// of 6.5 degrees). The rest is at most maxLost of the environment's light.
inline constexpr double minFacing = 0.998;
inline constexpr double maxLost = 1e-3;
// Least fraction of the light from all directions.
inline constexpr double minFraction = 0.002;

}  // namespace sun_spot

struct EnvironmentSun {
    bool found = false;
    std::string why;  // reason for users, if not found

    // The environment without the spot: its texels are lowered to the component-wise median of the texels
    // within two steps.
    Environment residual;
    // In the environment's axes. The direction is the luminance-weighted mean of the removed light. The
    // illuminance is that of a facing surface, per component. The angle is that of a uniform disc with
    // this illuminance and mean squared radiance.
    Light light;
    double fraction = 0;  // of the environment's luminance
};

// Extracts the spot with the most luminance that meets the criteria. Integrates the bilinear image that
// scene.h describes, in double.
EnvironmentSun environmentSun(const Environment& environment);

// The light in world axes, for an environment rotated about +Y by `degrees`, counter-clockwise seen from
// above, and scaled by `factor`.
Light rotatedSun(const Light& light, double degrees, double factor);

// "of 0.53 degrees, towards (0.3, 0.8, 0.5), 12.4 (10.1, 9.2, 8.1) lux, 63 % of the environment's light",
// for a light of rotatedSun().
std::string describe(const Light& sun, double fraction);

}  // namespace diptych
