// SPDX-License-Identifier: MIT
// The vertices of an instance: morph targets first, then joints (glTF 2.0, 3.7.2.2 and 3.7.3.3), in double.
#pragma once

#include "shared/scene/model/scene.h"
#include "shared/scene/motion/instances.h"

#include <vector>

namespace diptych {

// World space. Positions that are beyond maxCoordinate or not finite become NaN, and triangles that use them
// are not drawn.
std::vector<glm::dvec3> posedPositions(const Scene& scene, const Pose& pose, const Instance& instance);

// Normals and tangents are unit, or 0 where they have no direction. A normal is transformed by the mean of
// the inverse transposes of its vertex's joints, or with `blended_normals` by that of the mean of their
// matrices, and points to the side from which the triangle's front is seen under the handedness of
// world_from_object; the normals of a flat primitive are those of its posed triangles. Tangents move with the
// surface, whether they are the file's or come from makeTangents. Where a target with a weight or a turned
// normal map moves what the latter follow from, they are made anew (morphed_tangents.h). The sign of a
// bitangent is the primitive's times that of the determinant of world_from_object, times `bitangents`.
struct PosedVertices {
    std::vector<glm::dvec3> positions, normals, tangents;
    std::vector<glm::dvec2> texcoords[2];  // empty where no target with a weight moves them
    std::vector<glm::dvec4> colors;        // likewise; 0..1
    double bitangents = 1;                 // -1 where an animation has mirrored the normal map
};
PosedVertices posedVertices(const Scene& scene, const Pose& pose, const Instance& instance,
                            bool blended_normals = false);

}  // namespace diptych
