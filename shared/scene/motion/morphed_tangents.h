// SPDX-License-Identifier: MIT
// Tangents of a morphed primitive whose file has none, made anew for the pose.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace diptych {

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
