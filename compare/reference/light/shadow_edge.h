// SPDX-License-Identifier: MIT
// Distance of a point from a shadow boundary. A filtered shadow map may have any value within its filter
// radius of the boundary, and must be right elsewhere.
#pragma once

#include <glm/vec3.hpp>

#include <functional>

namespace diptych::reference {

// Whether a point sees the light.
using SeesLight = std::function<bool(const glm::dvec3& position)>;

// The distance across the light, m, from `position` to the nearest change of visibility in the plane through
// it with `normal`. It is at most the distance of a straight boundary; infinite if nothing is found up to
// `farthest`, m.
// Searches eight directions. Radii start at 1/8192 of the distance from the camera, the origin, and
// double. The boundary is refined to a sixteenth of its radius; narrower features may be missed.
// `normal` and `to_light` are unit vectors less than 90 degrees apart.
double edgeDistance(const SeesLight& sees, const glm::dvec3& position, const glm::dvec3& normal,
                    const glm::dvec3& to_light, double farthest);

}  // namespace diptych::reference
