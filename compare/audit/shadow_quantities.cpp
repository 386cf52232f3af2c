// SPDX-License-Identifier: MIT
#include "compare/audit/groups.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace diptych::audit {

namespace {

const Light* sunOf(const Scene& scene) {
    const auto sun = std::ranges::find(scene.lights, LightKind::directional, &Light::kind);
    return sun == scene.lights.end() ? nullptr : &*sun;
}

void castIfNoneDoes(Case& pushed) {
    if (pushed.settings.shadows == Shadows::off) pushed.settings.shadows = Shadows::pcf;
}

// Adds a small triangle far towards the directional light. It casts no visible shadow, but shadow maps
// must reach it.
void pushCaster(Case& pushed, const Subject& subject, double metres) {
    castIfNoneDoes(pushed);
    Scene& scene = pushed.scene;
    const glm::dvec3 up = -glm::normalize(sunOf(scene)->direction);
    const glm::dvec3 beside =
        glm::normalize(glm::cross(up, std::abs(up.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const double radius = std::max(subject.bounds.radius(), 1e-6);
    const glm::dvec3 place = subject.bounds.centre() + up * (radius + metres) + beside * (0.5 * radius);
    const double size = 1e-3 * radius;
    Primitive triangle;
    for (const glm::dvec3& corner : {glm::dvec3(0), size * beside, size * glm::cross(up, beside)}) {
        triangle.positions.emplace_back(corner);
        triangle.normals.emplace_back(up);
        triangle.tangents.emplace_back(glm::vec3(beside), 1.0f);
    }
    triangle.indices = {0, 1, 2};
    Material black;
    black.base_color = {0, 0, 0, 1};
    triangle.material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(black);
    glm::dmat4 there(1);
    there[3] = glm::dvec4(place, 1);
    scene.nodes.push_back(
        {.name = "caster", .parent_from_node = there, .mesh = static_cast<int>(scene.meshes.size())});
    scene.meshes.push_back({.name = "caster", .primitives = {std::move(triangle)}});
}

// Map depth is reversed: 0 where the scene ends, so its steps there are of the scene's size, however far
// the nearest caster is. Moments have one exponent for the whole range, and lose precision for near
// depths.
Predicted predictCaster(const Subject& subject, const Settings& settings, double) {
    const Shadows kind = settings.shadows;
    if (kind == Shadows::evsm || kind == Shadows::evsm4 || kind == Shadows::msm4)
        return {.up = 0x1p24 * std::max(subject.bounds.radius(), 1e-6),
                .because =
                    "moments use depths from 0 to 1, and float32 resolves 2^-24: a range of that many scene "
                    "radii makes the scene one depth; a moment filter may fail earlier",
                .at_most = true};
    return {.because =
                "shadow-map depth is reversed: float32 is finest at the scene's far end, with steps relative "
                "to the scene's size wherever the range begins"};
}

double originalCaster(const Subject& subject) {
    return std::max(subject.bounds.radius(), 1e-6);
}

void pushExponent(Case& pushed, const Subject&, double exponent) {
    if (pushed.settings.shadows != Shadows::evsm4) pushed.settings.shadows = Shadows::evsm;
    pushed.settings.evsm_exponent = static_cast<float>(exponent);
    pushed.settings.evsm_precision = EvsmPrecision::fp32;
}

double originalExponent(const Subject&) {
    return 10;
}

Predicted predictExponent(const Subject&, const Settings&, double) {
    return {.up = 44.36, .because = "the second moment is at most exp(2 x 44.36), the end of float32"};
}

void pushHaze(Case& pushed, const Subject&, double density) {
    pushed.settings.haze = true;
    pushed.settings.haze_density = static_cast<float>(density);
}

// The nearest surface is the brightest through the air: once its light underflows float32, the image is
// empty.
Predicted predictHaze(const Subject& subject, const Settings& settings, double) {
    if (settings.haze_march_steps > 0 || !subject.seen) return {};
    const Rgb &r = settings.haze_rayleigh, &m = settings.haze_mie;
    const double least = std::min({double{r.r} + m.r, double{r.g} + m.g, double{r.b} + m.b});
    constexpr double opaque = 87;  // e^-87 is float32's smallest normal number
    return {.up = opaque / (least * subject.nearest),
            .because =
                "float32 transmittance is 0 beyond an optical depth of 87, which the nearest surface reaches "
                "there"};
}

}  // namespace

std::vector<Quantity> shadowQuantities() {
    return {{.name = "shadow_depth",
             .unit = "m",
             .what = "distance of an additional small shadow caster beyond the scene, towards the sun",
             .magnitudes = ladder(1, 1e8),
             .original = originalCaster,
             .lacks = lacksSun,
             .push = pushCaster,
             .variants = {{"shadows", "evsm"}, {"shadows", "msm4"}},
             .predict = predictCaster},
            {.name = "evsm_exponent",
             .unit = "",
             .what = "the positive exponent of 32-bit exponential variance shadow maps",
             .magnitudes = {1, 2, 5, 10, 20, 30, 40, 44, 44.36},
             .original = originalExponent,
             .lacks = lacksSun,
             .push = pushExponent,
             .predict = predictExponent},
            {.name = "haze",
             .unit = "",
             .what = "the density of haze",
             .magnitudes = ladder(1e-9, 1e9),
             .original = originalOne,
             .lacks = lacksNothing,
             .push = pushHaze,
             .variants = {{"haze-march-steps", "32"}},
             .predict = predictHaze}};
}

}  // namespace diptych::audit
