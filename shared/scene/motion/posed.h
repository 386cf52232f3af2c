// SPDX-License-Identifier: MIT
// Where an instance's vertices are: morph targets first, then joints (glTF 2.0, 3.7.2.2 and 3.7.3.3), in
// double.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/pose.h"

#include <vector>

namespace diptych {

// World space. What lies beyond maxCoordinate or nowhere has positions that are not a number: its triangles
// are not there.
std::vector<glm::dvec3> posedPositions(const Scene& scene, const Pose& pose, const Instance& instance);

// Normals and tangents are unit, or 0 where nothing is left of them. A normal moves by the inverse transpose
// of what moves its vertex and points to the side from which world_from_object's handedness shows the
// triangle's front; a flat primitive's follows from the posed triangle. Tangents move with the surface, those
// that makeTangents made as well as the file's: what a target adds is what the file says. The sign of a
// bitangent is the primitive's times that of world_from_object's determinant.
struct PosedVertices {
    std::vector<glm::dvec3> positions, normals, tangents;
};
PosedVertices posedVertices(const Scene& scene, const Pose& pose, const Instance& instance);

}  // namespace diptych
