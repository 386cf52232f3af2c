// SPDX-License-Identifier: MIT
// Tangents of a primitive whose file has none, made anew for the pose where targets or its normal map move.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace diptych {

// Whether an animation has turned, stretched or mirrored a normal map. Tangents do not feel an offset.
inline bool isTurned(const TextureSlot& rest, const TextureSlot& now) {
    return glm::dvec2(rest.u) != glm::dvec2(now.u) || glm::dvec2(rest.v) != glm::dvec2(now.v);
}
// -1 where it has been mirrored, which turns bitangents round; else 1.
inline double mirroredSign(const TextureSlot& rest, const TextureSlot& now) {
    const auto area = [](const TextureSlot& slot) { return slot.u.x * slot.v.y - slot.u.y * slot.v.x; };
    return (area(rest) < 0) != (area(now) < 0) ? -1 : 1;
}

// As makeTangents() would make them of these vertices (M. Mikkelsen, "Simulation of Wrinkled Surfaces
// Revisited", 2008), but grouped as primitive.tangent_groups says, which is not empty: a group's tangent is
// the mean of dP/ds of its corners' triangles, each projected into the plane of the vertex's normal and
// weighted by the corner's angle in that plane. By vertex: object space, unit; perpendicular to the normal in
// any direction where no triangle has a derivative. `normals` are unit, or 0 where they have no direction;
// `texcoords` are of the set of `map`, before its transform.
std::vector<glm::dvec3> morphedTangents(const Primitive& primitive, const TextureSlot& map,
                                        const std::vector<glm::dvec3>& positions,
                                        const std::vector<glm::dvec3>& normals,
                                        const std::vector<glm::dvec2>& texcoords);

}  // namespace diptych
