// SPDX-License-Identifier: MIT
// Vertices that the kernels of posing made, held against posedVertices() in double.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/motion/posed.h"

#include <string>
#include <vector>

namespace diptych {

// The largest errors so far.
struct PosingErrors {
    double position = 0;                    // of the diagonal of the instance's box
    double normal = 0;                      // degrees, where the vertex's matrix stretches by at most 4:1
    double normal_bound = 0;                // of any normal, in parts of what rounding may do
    double tangent_bound = 0;               // likewise, of tangents that move as the surface does
    double fresh_tangent = 0;               // degrees, of those made of the morphed surface
    double attribute_bound = 0;             // likewise, of colours and texture coordinates
    std::size_t vertices = 0, missing = 0;  // missing: NaN on both sides
};

// Poses the scene on the device and fails the test where a vertex is further from the one in double than
//  - positions: 1e-5 of the diagonal of the instance's box, and what float32 rounds;
//  - normals: 0.05 degrees where the vertex's matrix stretches by at most 4:1, else what float32 rounds;
//  - tangents: what float32 rounds, or 0.05 degrees where they are made anew;
//  - colours and texture coordinates: what float32 rounds, and the same bits where no target moves them.
// What float32 rounds: a bound on the sum of all operations' errors, half an ULP of the largest number in
// each, from the vertex's own matrices, weights and deltas.
void comparePosing(const Scene& scene, const Pose& pose, const std::string& what, PosingErrors& errors,
                   SkinNormals normals = SkinNormals::joints);

// What a kernel makes of the scene's normals, instance by instance.
std::vector<glm::vec3> posedNormals(const Scene& scene, const Pose& pose, SkinNormals normals);

void printErrors(const std::string& what, const PosingErrors& errors);

}  // namespace diptych
