// SPDX-License-Identifier: MIT
// Computes the vertices of an instance in double: morph targets, then joints (glTF 2.0, 3.7.2.2 and
// 3.7.3.3).
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/instances.h"

#include <vector>

namespace diptych {

// World space. Positions that exceed maxCoordinate or are not finite become NaN; triangles that use them
// are not drawn.
std::vector<glm::dvec3> posedPositions(const Scene& scene, const Pose& pose, const Instance& instance);

// Normals and tangents are unit, or 0 if undefined. A normal is transformed by the mean of the joints'
// inverse transposes, or with `blended_normals` by the inverse transpose of their mean. It points to the
// front side, given the handedness of world_from_object. A flat primitive gets the normals of its posed
// triangles. Tangents move with the surface. Those from makeTangents are recomputed if targets of non-zero
// weight or an animated map change them (morphed_tangents.h). A bitangent's sign is the
// primitive's, times the sign of world_from_object's determinant, times `bitangents`.
struct PosedVertices {
    std::vector<glm::dvec3> positions, normals, tangents;
    std::vector<glm::dvec2> texcoords[2];  // empty if no target of non-zero weight moves them
    std::vector<glm::dvec4> colors;        // likewise; 0 to 1
    double bitangents = 1;                 // -1 if an animation mirrored the map of tangents
};
PosedVertices posedVertices(const Scene& scene, const Pose& pose, const Instance& instance,
                            bool blended_normals = false);

}  // namespace diptych
