// SPDX-License-Identifier: MIT
// Recomputes generated tangents for a pose in which morph targets or an animated map (tangentMap()) change
// them.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace diptych {

// Whether an animation has rotated, scaled or mirrored a map. An offset does not affect tangents.
inline bool isRotated(const TextureSlot& rest, const TextureSlot& now) {
    return glm::dvec2(rest.u) != glm::dvec2(now.u) || glm::dvec2(rest.v) != glm::dvec2(now.v);
}
// -1 if animation mirrored the map, which flips bitangents; else 1.
inline double mirroredSign(const TextureSlot& rest, const TextureSlot& now) {
    const auto area = [](const TextureSlot& slot) { return slot.u.x * slot.v.y - slot.u.y * slot.v.x; };
    return (area(rest) < 0) != (area(now) < 0) ? -1 : 1;
}

// As makeTangents() (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008), but with the groups
// of primitive.tangent_groups, which must not be empty. A group's tangent is the mean of its triangles'
// dP/ds. Each is projected into the plane of the vertex normal and weighted by the corner's angle there.
// Result by vertex: object space, unit; any perpendicular to the normal if no triangle has a derivative.
// `normals` are unit, or 0 if undefined. `texcoords` are those of the map's set, before its transform.
std::vector<glm::dvec3> morphedTangents(const Primitive& primitive, const TextureSlot& map,
                                        const std::vector<glm::dvec3>& positions,
                                        const std::vector<glm::dvec3>& normals,
                                        const std::vector<glm::dvec2>& texcoords);

}  // namespace diptych
