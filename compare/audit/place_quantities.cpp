// SPDX-License-Identifier: MIT
#include "compare/audit/groups.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::audit {

namespace {

// Horizontal, so that haze stays the same, and along no axis.
const glm::dvec3 away = glm::normalize(glm::dvec3(0.8, 0, 0.6));

void pushOffset(Case& pushed, const Subject&, double metres) {
    moveAll(pushed, glm::translate(glm::dmat4(1), metres * away));
}

void pushScale(Case& pushed, const Subject&, double factor) {
    scaleLengths(pushed, factor);
}

// Moves vertices far from their mesh's origin; its node moves them back.
void pushVertex(Case& pushed, const Subject&, double metres) {
    Scene& scene = pushed.scene;
    const glm::dvec3 offset = metres * away;
    for (Mesh& mesh : scene.meshes)
        for (Primitive& primitive : mesh.primitives) {
            if (!primitive.joint_sets.empty()) continue;  // the skin's matrices place them
            for (glm::vec3& position : primitive.positions)
                position = glm::vec3(glm::dvec3(position) + offset);
            primitive.deformation_bounds = {};
        }
    const auto back = glm::translate(glm::dmat4(1), -offset);
    // Moves back only the mesh, not child nodes.
    const std::size_t count = scene.nodes.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (scene.nodes[i].mesh < 0 || scene.nodes[i].skin >= 0) continue;
        Node carrier = scene.nodes[i];
        carrier.parent = static_cast<int>(i);
        carrier.parent_from_node = back;
        carrier.transform = -1;
        if (carrier.copies >= 0) {
            for (glm::dmat4& copy : scene.copies[static_cast<std::size_t>(carrier.copies)])
                copy = copy * back;
            continue;
        }
        scene.nodes[i].mesh = -1;
        scene.nodes.push_back(std::move(carrier));
    }
}

// Viewing distance, m.
double distanceOf(const Subject& subject) {
    return subject.seen ? glm::distance(subject.point, subject.view.eye())
                        : std::max(subject.bounds.radius(), 1e-6);
}

Predicted predictOffset(const Subject& subject, const Settings&, double error) {
    return {
        .up = error * distanceOf(subject) * 0x1p53,
        .because = "positions relative to the camera are computed in double, with 53 bits for the offset"};
}

Predicted predictVertex(const Subject&, const Settings&, double) {
    return {.because =
                "vertices are stored relative to the middle of all meshes, which is exact: float32 only "
                "spans the scene's size"};
}

Predicted predictScale(const Subject& subject, const Settings&, double) {
    double least = std::numeric_limits<double>::infinity();
    for (const Light& light : subject.given.scene.lights)
        if (light.kind == LightKind::point || light.kind == LightKind::spot)
            least = std::min(least, double{light.intensity});
    // Candela scale with the square of the factor.
    const double dim = std::isfinite(least) && least > 0 ? std::sqrt(0x1p-126 / least) : 0;
    return {.up = maxCoordinate / std::max(subject.bounds.radius(), 1e-30),
            .down = std::max(dim, 0x1p-63 / distanceOf(subject)),
            .because =
                "squared lengths and candela are float32, 1e-38 to 3e38, and candela grow with the square of "
                "the factor"};
}

double originalOffset(const Subject&) {
    return 0;
}

}  // namespace

std::vector<Quantity> placeQuantities() {
    std::vector<double> offsets = ladder(1, 1e8);
    offsets.insert(offsets.begin(), 0);
    std::vector<double> vertices = ladder(1, 1e7);
    vertices.insert(vertices.begin(), 0);
    return {{.name = "offset",
             .unit = "m",
             .what = "distance from the origin of scene, lights and camera together",
             .magnitudes = offsets,
             .original = originalOffset,
             .lacks = lacksNothing,
             .push = pushOffset,
             .same_picture = true,
             .predict = predictOffset},
            {.name = "vertex",
             .unit = "m",
             .what = "distance of vertices from their mesh's origin, which its node compensates",
             .magnitudes = vertices,
             .original = originalOffset,
             .lacks = lacksNothing,
             .push = pushVertex,
             .predict = predictVertex},
            {.name = "scale",
             .unit = "",
             .what = "factor on all lengths, with intensities adjusted so that the picture stays the same",
             .magnitudes = ladder(1e-6, 1e6),
             .original = originalOne,
             .lacks = lacksNothing,
             .push = pushScale,
             .same_picture = true,
             .lengths = true,
             .predict = predictScale}};
}

}  // namespace diptych::audit
