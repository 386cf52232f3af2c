// SPDX-License-Identifier: MIT
// Bounds of a primitive's posed vertices from precomputed data: the cost of a pose grows with joints and
// targets, not with vertices.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace diptych {

// Groups the vertices into clusters; those of large primitives have at least 8 vertices.
DeformationBounds deformationBounds(const Primitive& primitive);

// Only DeformationBounds::main_joint.
std::uint32_t mainJoint(const Primitive& primitive);

// Fills Primitive::deformation_bounds of all primitives with joints, targets or animated tangents. If
// vertices, joint sets or targets change afterwards, deformation_bounds must be cleared.
void prepareDeformationBounds(Scene& scene);

// The inputs for posing a primitive: see posed.h.
struct Deformation {
    glm::dmat4 world_from_object{1.0};
    const std::vector<glm::dmat4>* world_from_mesh = nullptr;  // by joint; nullptr: not skinned
    const std::vector<double>* weights = nullptr;              // by target; nullptr: no target applies
};

struct WorldBox {
    glm::dvec3 min{0}, max{0};  // world, m; within maxCoordinate
};

// A box around all posed vertices, whether computed in double, or in float32 with an error of up to 1e-5
// of the box's diagonal. A vertex is a convex combination, with weights a_j, of M_j q: the transforms M_j
// of its joints applied to its morphed position q. So it is in the hull of the boxes M_j q. For any joint
// r, it is also at M_r q + sum over the others of a_j (M_j - M_r) q. That sum is small where the joints
// meet. Each cluster is bounded by both.
WorldBox boundsOf(const DeformationBounds& bounds, const Deformation& deformation);

}  // namespace diptych
