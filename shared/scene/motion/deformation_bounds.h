// SPDX-License-Identifier: MIT
// Bounds of the posed vertices of a primitive, from data that is prepared once: the cost of a pose is that of
// the joints and targets, not of the vertices.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace diptych {

// Its vertices in clusters; a cluster of a large primitive has 8 vertices or more.
DeformationBounds deformationBounds(const Primitive& primitive);

// DeformationBounds::main_joint alone.
std::uint32_t mainJoint(const Primitive& primitive);

// Fills Primitive::deformation_bounds of all primitives that joints or targets move or whose tangents are
// made anew over time. Vertices, joint sets and targets must not be changed afterwards, or deformation_bounds
// be cleared.
void prepareDeformationBounds(Scene& scene);

// Where a primitive is in a pose: what posed.h computes each vertex of.
struct Deformation {
    glm::dmat4 world_from_object{1.0};
    const std::vector<glm::dmat4>* world_from_mesh = nullptr;  // by joint; nullptr: not skinned
    const std::vector<double>* weights = nullptr;              // by target; nullptr: no target applies
};

struct WorldBox {
    glm::dvec3 min{0}, max{0};  // world, m; within maxCoordinate
};

// A box that no vertex posed in double leaves, nor one that is posed in float32 and off by 1e-5 of the box's
// diagonal. A vertex is a convex combination of its joints' transforms of its morphed position q. So with the
// shares a_j it lies in the hull of the boxes M_j q; and, for any joint r, at M_r q + sum of a_j (M_j - M_r)
// q over the others, which is little where the joints meet. Each cluster is bounded by both.
WorldBox boundsOf(const DeformationBounds& bounds, const Deformation& deformation);

}  // namespace diptych
