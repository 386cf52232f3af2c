// SPDX-License-Identifier: MIT
#include "compare/audit/groups.h"
#include "shared/scene/default_view.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::audit {

namespace {

std::string lacksPerspective(const Subject& subject) {
    return subject.view.camera.orthographic ? "the camera is orthographic" : "";
}

// A far plane beyond the whole scene, m.
double farOf(const Subject& subject) {
    const double reach = glm::distance(subject.bounds.centre(), subject.view.eye()) + subject.bounds.radius();
    return std::isfinite(subject.view.camera.far) ? subject.view.camera.far : 2 * reach;
}

double originalNear(const Subject& subject) {
    return farOf(subject) / subject.view.camera.near;
}

void pushNear(Case& pushed, const Subject& subject, double ratio) {
    pushed.camera().far = farOf(subject);
    pushed.camera().near = pushed.camera().far / ratio;
}

double originalFov(const Subject& subject) {
    return glm::degrees(subject.view.camera.yfov);
}

void pushFov(Case& pushed, const Subject&, double degrees) {
    pushed.camera().yfov = glm::radians(degrees);
}

// Rotates the eye around the point in the image's centre, at the same distance, until it sees the surface
// there under this angle.
void pushGrazing(Case& pushed, const Subject& subject, double degrees) {
    const glm::dvec3 to_eye = subject.view.eye() - subject.point;
    glm::dvec3 along = to_eye - glm::dot(to_eye, subject.normal) * subject.normal;
    if (!(glm::length(along) > 1e-6 * glm::length(to_eye)))
        along = glm::cross(subject.normal,
                           std::abs(subject.normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0));
    const double angle = glm::radians(degrees);
    const glm::dvec3 direction = std::cos(angle) * glm::normalize(along) + std::sin(angle) * subject.normal;
    const glm::dvec3 eye = subject.point + glm::length(to_eye) * direction;
    pushed.camera().world_from_camera = lookAt(eye, subject.point);
}

double originalGrazing(const Subject& subject) {
    const glm::dvec3 to_eye = glm::normalize(subject.view.eye() - subject.point);
    return glm::degrees(std::asin(std::clamp(glm::dot(to_eye, subject.normal), 0.0, 1.0)));
}

void pushExposure(Case& pushed, const Subject&, double factor) {
    pushed.exposure = factor;
}

Predicted predictExposure(const Subject&, const Settings&, double) {
    return {.because =
                "exposure multiplies float32 radiance in double, and both pictures are rounded to 8 bits "
                "after the tone curve"};
}

// Error of the stored depth, and its reason.
Predicted roundingOf(DepthFormat format) {
    switch (format) {
        case DepthFormat::d32f:
            break;
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
    if (settings.depth_format != DepthFormat::d32f) {
        double lamp = std::numeric_limits<double>::infinity();
        for (const Light& light : subject.given.scene.lights)
            if (light.kind != LightKind::directional)
                lamp = std::min(lamp, glm::distance(light.position, subject.point));
        const double farthest =
                         glm::distance(subject.bounds.centre(), subject.view.eye()) + subject.bounds.radius(),
                     middle = glm::distance(subject.point, subject.view.eye());
        Predicted predicted = roundingOf(settings.depth_format);
        predicted.up = error * farOf(subject) / (farthest * std::max(1.0, 2 * middle / lamp) * predicted.up);
        return predicted;
    }
    return {.because =
                "reversed float32 depth has 24 bits wherever the planes are, and one division turns it into "
                "a position"};
}

// A vertex is accurate to 2^-24 of its distance, which at such a small angle is part of a pixel. On an
// inclined surface its depth differs by as much.
Predicted predictFov(const Subject& subject, const Settings&, double) {
    const glm::dvec3 to_eye = glm::normalize(subject.view.eye() - subject.point);
    const double facing = subject.seen ? std::abs(glm::dot(to_eye, subject.normal)) : 1;
    return {
        .down = glm::degrees(0x1p-24 / std::max(facing, 0.01)),
        .because =
            "a vertex is accurate to 2^-24 of its distance: at that angle the whole picture is no larger"};
}

Predicted predictGrazing(const Subject&, const Settings&, double) {
    return {.because =
                "the material model clamps n.v to at least 1e-4, and the rasteriser interpolates depth by "
                "plane equations"};
}

}  // namespace

std::vector<Quantity> cameraQuantities() {
    std::vector<double> fovs = ladder(0.01, 10);
    for (const double wide : {30.0, 60.0, 90.0, 120.0, 150.0, 170.0, 179.0}) fovs.push_back(wide);
    std::vector<double> grazes = ladder(0.001, 10);
    for (const double steep : {30.0, 60.0, 90.0}) grazes.push_back(steep);
    return {
        {.name = "exposure",
         .unit = "",
         .what = "exposure of the 8-bit pictures, as a factor of the automatic exposure",
         .magnitudes = ladder(1e-30, 1e30, 1e3),
         .original = originalOne,
         .lacks = lacksNothing,
         .push = pushExposure,
         .of_pictures = true,
         .predict = predictExposure},
        {.name = "near",
         .unit = "",
         .what = "the far plane's distance divided by the near plane's, by moving the near plane",
         .magnitudes = ladder(1e2, 1e9),
         .original = originalNear,
         .lacks = lacksNothing,
         .push = pushNear,
         .variants = {{"depth-format", "d32f-standard"}, {"depth-format", "d24"}, {"depth-format", "d16"}},
         .predict = predictNear,
         .predicts_formats = true},
        {.name = "fov",
         .unit = "degrees",
         .what = "the vertical field of view, from the same camera position",
         .magnitudes = fovs,
         .original = originalFov,
         .lacks = lacksPerspective,
         .push = pushFov,
         .predict = predictFov},
        {.name = "grazing",
         .unit = "degrees",
         .what = "the angle between the view and the surface in the middle of the picture",
         .magnitudes = grazes,
         .original = originalGrazing,
         .lacks = lacksSurface,
         .push = pushGrazing,
         .predict = predictGrazing}};
}

}  // namespace diptych::audit
