// SPDX-License-Identifier: MIT
#include "compare/audit/quantities.h"
#include "shared/scene/default_view.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::audit {

namespace {

// Horizontal, so that haze stays the same, and along no axis.
const glm::dvec3 away = glm::normalize(glm::dvec3(0.8, 0, 0.6));

// Moves vertices far from their mesh's origin; its node moves them back.
void applyVertex(Case& changed, const Subject&, double metres) {
    Scene& scene = changed.scene;
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
        const Node& node = scene.nodes[i];
        if (node.mesh < 0 || node.skin >= 0) continue;
        if (node.copies >= 0) {
            for (glm::dmat4& copy : scene.copies[static_cast<std::size_t>(node.copies)]) copy = copy * back;
            continue;
        }
        carry(scene, i, node.mesh).parent_from_node = back;
        scene.nodes[i].mesh = -1;
    }
}

// Viewing distance, m.
double distanceOf(const Subject& subject) {
    return subject.has_surface ? subject.distance() : subject.radius();
}

Predicted predictOffset(const Subject& subject, const Settings&, double error) {
    return {
        .up = error * distanceOf(subject) * 0x1p53,
        .because = "positions relative to the camera are computed in double, with 53 bits for the offset"};
}

Predicted predictScale(const Subject& subject, const Settings&, double) {
    double min = std::numeric_limits<double>::infinity();
    for (const Light& light : subject.original.scene.lights)
        if (isPunctual(light) && light.intensity > 0) min = std::min(min, double{light.intensity});
    // Candela scale with the square of the factor.
    const double dim = std::sqrt(0x1p-126 / min);  // 0 without such lights
    return {.up = maxCoordinate / subject.radius(),
            .down = std::max(dim, 0x1p-63 / distanceOf(subject)),
            .because =
                "squared lengths and candela are float32, 1e-38 to 3e38, and candela grow with the square of "
                "the factor"};
}

// A far plane beyond the whole scene, m.
double farOf(const Subject& subject) {
    return std::isfinite(subject.view.camera.far) ? subject.view.camera.far : 2 * subject.farthest();
}

void applyNear(Case& changed, const Subject& subject, double ratio) {
    changed.camera().far = farOf(subject);
    changed.camera().near = changed.camera().far / ratio;
}

// Rotates the eye around the point in the image's centre, at the same distance, until it sees the surface
// there under this angle.
void applyGrazing(Case& changed, const Subject& subject, double degrees) {
    const glm::dvec3 to_eye = subject.view.eye() - subject.point;
    glm::dvec3 along = to_eye - glm::dot(to_eye, subject.normal) * subject.normal;
    if (!(glm::length(along) > 1e-6 * glm::length(to_eye)))
        along = glm::cross(subject.normal,
                           std::abs(subject.normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0));
    const double angle = glm::radians(degrees);
    const glm::dvec3 direction = std::cos(angle) * glm::normalize(along) + std::sin(angle) * subject.normal;
    const glm::dvec3 eye = subject.point + glm::length(to_eye) * direction;
    changed.camera().world_from_camera = lookAt(eye, subject.point);
}

double originalGrazing(const Subject& subject) {
    const glm::dvec3 to_eye = glm::normalize(subject.view.eye() - subject.point);
    return glm::degrees(std::asin(std::clamp(glm::dot(to_eye, subject.normal), 0.0, 1.0)));
}

// Error of the stored depth, and its reason.
Predicted roundingOf(DepthFormat format) {
    switch (format) {
        case DepthFormat::d32f:
            return {.because =
                        "reversed float32 depth has 24 bits wherever the planes are, and one division turns "
                        "it into a position"};
        case DepthFormat::d32f_standard:
            return {.up = 0x1p-24,
                    .because = "depth is stored near 1 at any distance, with two rounding errors of 24 bits"};
        case DepthFormat::d24:
            return {.up = 0x1p-25, .because = "depth has a rounding error of half a 24-bit step"};
        case DepthFormat::d16:
            return {.up = 0.5 / 65535, .because = "depth has a rounding error of half a 16-bit step"};
    }
    return {};
}

// A depth step dz changes the distance d by the relative amount d (f - n) / (n f) dz, most for the
// farthest surface. Light from a lamp at distance r from the centre changes there by 2 d / r times as
// much.
Predicted predictNear(const Subject& subject, const Settings& settings, double error) {
    Predicted predicted = roundingOf(settings.depth_format);
    if (settings.depth_format == DepthFormat::d32f) return predicted;
    const double brighter = std::max(1.0, 2 * subject.distance() / localDistance(subject, subject.point));
    predicted.up = error * farOf(subject) / (subject.farthest() * brighter * predicted.up);
    return predicted;
}

// A vertex is accurate to 2^-24 of its distance, which at such a small angle is part of a pixel. On an
// inclined surface its depth differs by as much.
Predicted predictFov(const Subject& subject, const Settings&, double) {
    const glm::dvec3 to_eye = glm::normalize(subject.view.eye() - subject.point);
    const double facing = subject.has_surface ? std::abs(glm::dot(to_eye, subject.normal)) : 1;
    return {
        .down = glm::degrees(0x1p-24 / std::max(facing, 0.01)),
        .because =
            "a vertex is accurate to 2^-24 of its distance: at that angle the whole picture is no larger"};
}

}  // namespace

// One table, longer than a function should be.
std::vector<Quantity> transformQuantities() {
    constexpr auto originalNone = [](const Subject&) { return 0.0; };
    return {
        {.name = "offset",
         .unit = "m",
         .what = "distance from the origin of scene, lights and camera together",
         .magnitudes = ladder(1, 1e8, 10, {0}),
         .original = originalNone,
         .apply = [](Case& changed, const Subject&,
                     double metres) { moveAll(changed, glm::translate(glm::dmat4(1), metres * away)); },
         .same_image = true,
         .predict = predictOffset},
        {.name = "vertex",
         .unit = "m",
         .what = "distance of vertices from their mesh's origin, which its node compensates",
         .magnitudes = ladder(1, 1e7, 10, {0}),
         .original = originalNone,
         .apply = applyVertex,
         .because = "vertices are stored relative to the middle of all meshes, which is exact: float32 only "
                    "spans the scene's size"},
        {.name = "scale",
         .what = "factor on all lengths, with intensities adjusted so that the picture stays the same",
         .magnitudes = ladder(1e-6, 1e6),
         .apply = [](Case& changed, const Subject&, double factor) { scaleLengths(changed, factor); },
         .same_image = true,
         .lengths = true,
         .predict = predictScale},
        {.name = "exposure",
         .what = "exposure of the 8-bit pictures, as a factor of the automatic exposure",
         .magnitudes = ladder(1e-30, 1e30, 1e3),
         .apply = [](Case& changed, const Subject&, double factor) { changed.exposure = factor; },
         .of_images = true,
         .because = "exposure multiplies float32 radiance in double, and both pictures are rounded to 8 bits "
                    "after the tone curve"},
        {.name = "near",
         .what = "the far plane's distance divided by the near plane's, by moving the near plane",
         .magnitudes = ladder(1e2, 1e9),
         .original = [](const Subject& subject) { return farOf(subject) / subject.view.camera.near; },
         .apply = applyNear,
         .variants = {{"depth-format", "d32f-standard"}, {"depth-format", "d24"}, {"depth-format", "d16"}},
         .predict = predictNear,
         .predicts_formats = true},
        {.name = "fov",
         .unit = "degrees",
         .what = "the vertical field of view, from the same camera position",
         .magnitudes = ladder(0.01, 10, 10, {30, 60, 90, 120, 150, 170, 179}),
         .original = [](const Subject& subject) { return glm::degrees(subject.view.camera.yfov); },
         .lacks = {lacksPerspective},
         .apply = [](Case& changed, const Subject&,
                     double degrees) { changed.camera().yfov = glm::radians(degrees); },
         .predict = predictFov},
        {.name = "grazing",
         .unit = "degrees",
         .what = "the angle between the view and the surface in the middle of the picture",
         .magnitudes = ladder(0.001, 10, 10, {30, 60, 90}),
         .original = originalGrazing,
         .lacks = {lacksPerspective, lacksSurface},
         .apply = applyGrazing,
         .because =
             "the material model clamps n.v to at least 1e-4, and the rasteriser interpolates depth by "
             "plane equations"},
    };
}

}  // namespace diptych::audit
