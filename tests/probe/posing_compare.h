// SPDX-License-Identifier: MIT
// Compares vertices deformed by the compute shaders with posedVertices() in double.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/motion/posed.h"

#include <string>
#include <vector>

namespace diptych {

// The largest errors so far.
struct PosingErrors {
    double position = 0;                    // relative to the diagonal of the instance's box
    double normal = 0;                      // degrees, where the vertex's matrix stretches by at most 4:1
    double normal_bound = 0;                // any normal, relative to the rounding bound
    double tangent_bound = 0;               // likewise, tangents that deform with the surface
    double fresh_tangent = 0;               // degrees, tangents recomputed from the morphed surface
    double attribute_bound = 0;             // likewise, colours and texture coordinates
    std::size_t vertices = 0, missing = 0;  // missing: NaN on both sides
};

// Deforms the scene on the device and fails the test if a vertex differs from the double result by more
// than
// - positions: 1e-5 of the diagonal of the instance's box, plus float32 rounding;
// - normals: 0.05 degrees where the vertex's matrix stretches by at most 4:1, else float32 rounding;
// - tangents: float32 rounding, or 0.05 degrees if they are recomputed;
// - colours and texture coordinates: float32 rounding; the same bits if no target changes them.
// Float32 rounding is a bound on the sum of all operations' errors, half an ULP of the largest operand
// each, from the vertex's own matrices, weights and deltas.
void comparePosing(const Scene& scene, const Pose& pose, const std::string& what, PosingErrors& errors,
                   SkinNormals normals = SkinNormals::joints);

// The scene's normals as a compute shader deforms them, instance by instance.
std::vector<glm::vec3> posedNormals(const Scene& scene, const Pose& pose, SkinNormals normals);

void printErrors(const std::string& what, const PosingErrors& errors);

}  // namespace diptych
