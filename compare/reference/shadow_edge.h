// SPDX-License-Identifier: MIT
// How far a point is from the edge of a shadow: a filtered shadow map may show anything within its filter's
// reach of one, and must be right elsewhere.
#pragma once

#include <glm/vec3.hpp>

#include <functional>

namespace diptych::reference {

// Whether a point sees the light.
using SeesLight = std::function<bool(const glm::dvec3& place)>;

// The distance across the light, m, from `place` to where the plane through it with `normal` sees the light
// otherwise, and no more than that of a straight edge; infinite where nothing is found up to `farthest`, m.
// Eight directions are followed at radii from 1/8192 of the distance from the camera, the origin, on, each
// twice the one before, and the edge is found to a sixteenth of its radius: what is narrower may be missed.
// `normal` and `to_light` are unit vectors less than 90 degrees apart.
double edgeDistance(const SeesLight& sees, const glm::dvec3& place, const glm::dvec3& normal,
                    const glm::dvec3& to_light, double farthest);

}  // namespace diptych::reference
