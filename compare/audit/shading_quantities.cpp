// SPDX-License-Identifier: MIT
#include "compare/audit/quantities.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace diptych::audit {

namespace {

void applyRoughness(Case& changed, const Subject&, double roughness) {
    for (Material& material : changed.scene.materials) material.roughness = static_cast<float>(roughness);
}

std::string lacksNormalMap(const Subject& subject) {
    const bool any = std::ranges::any_of(subject.original.scene.materials, [](const Material& material) {
        return material.normal_texture.texture >= 0;
    });
    return any ? "" : "no material has a normal map";
}
std::string lacksTexture(const Subject& subject) {
    return subject.original.scene.images.empty() ? "no material has a texture" : "";
}

void applyNormalMap(Case& changed, const Subject&, double strength) {
    for (Material& material : changed.scene.materials)
        if (material.normal_texture.texture >= 0) material.normal_scale = static_cast<float>(strength);
}

// Replaces every surface's emission.
void applyEmission(Case& changed, const Subject&, double radiance) {
    const auto sent = static_cast<float>(std::min(radiance, double{std::numeric_limits<float>::max()}));
    for (Material& material : changed.scene.materials) material.emissive = glm::vec3(sent);
    for (auto& [index, parts] : changed.scene.material_parts) {
        parts.emissive = glm::dvec3(1);
        parts.emissive_strength = radiance;
    }
}

// Sets every vertex colour, beside the material's colour.
void applyColor(Case& changed, const Subject&, double factor) {
    for (Mesh& mesh : changed.scene.meshes)
        for (Primitive& primitive : mesh.primitives)
            primitive.colors.assign(primitive.positions.size(),
                                    glm::vec4(glm::vec3(static_cast<float>(factor)), 1));
}

// Colours, normals and all else; keeps alpha, which decides where a surface is.
template <class Value>
void setTexels(std::vector<Value>& texels, Value value) {
    for (std::size_t i = 0; i < texels.size(); ++i)
        if (i % 4 != 3) texels[i] = value;
}

void applyTexel(Case& changed, const Subject&, double fraction) {
    for (TextureImage& image : changed.scene.images) {
        setTexels(image.rgba, static_cast<std::uint8_t>(std::lround(fraction * 0xFF)));
        setTexels(image.rgba16, static_cast<std::uint16_t>(std::lround(fraction * 0xFFFF)));
        setTexels(image.rgba32, static_cast<float>(fraction) * image.largest);
    }
}

// Adds a small triangle far towards the directional light. It casts no visible shadow, but shadow maps
// must reach it.
void applyCaster(Case& changed, const Subject& subject, double metres) {
    if (changed.settings.shadows == Shadows::off) changed.settings.shadows = Shadows::pcf;
    Scene& scene = changed.scene;
    const auto sun = std::ranges::find(scene.lights, LightKind::directional, &Light::kind);
    const glm::dvec3 up = -glm::normalize(sun->direction);
    const glm::dvec3 beside =
        glm::normalize(glm::cross(up, std::abs(up.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const double radius = subject.radius();
    const glm::dvec3 position = subject.bounds.centre() + up * (radius + metres) + beside * (0.5 * radius);
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
    there[3] = glm::dvec4(position, 1);
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
        return {.up = 0x1p24 * subject.radius(),
                .because =
                    "moments use depths from 0 to 1, and float32 resolves 2^-24: a range of that many scene "
                    "radii makes the scene one depth; a moment filter may fail earlier",
                .at_most = true};
    return {.because =
                "shadow-map depth is reversed: float32 is finest at the scene's far end, with steps relative "
                "to the scene's size wherever the range begins"};
}

void applyExponent(Case& changed, const Subject&, double exponent) {
    if (changed.settings.shadows != Shadows::evsm4) changed.settings.shadows = Shadows::evsm;
    changed.settings.evsm_exponent = static_cast<float>(exponent);
    changed.settings.evsm_precision = EvsmPrecision::fp32;
}

void applyHaze(Case& changed, const Subject&, double density) {
    changed.settings.haze = true;
    changed.settings.haze_density = static_cast<float>(density);
}

// The nearest surface is the brightest through the air: once its light underflows float32, the image is
// empty.
Predicted predictHaze(const Subject& subject, const Settings& settings, double) {
    if (settings.haze_march_steps > 0 || !subject.has_surface) return {};
    const Rgb &r = settings.haze_rayleigh, &m = settings.haze_mie;
    const double min = std::min({double{r.r} + m.r, double{r.g} + m.g, double{r.b} + m.b});
    constexpr double opaque = 87;  // e^-87 is float32's smallest normal number
    return {.up = opaque / (min * subject.nearest),
            .because =
                "float32 transmittance is 0 beyond an optical depth of 87, which the nearest surface reaches "
                "there"};
}

}  // namespace

std::vector<Quantity> shadingQuantities() {
    return {
        {.name = "roughness",
         .what = "the roughness factor of every material",
         .magnitudes = ladder(1e-6, 1e-2, 10, {0, 0.02, 0.03, 0.045, 0.06, 0.1, 0.2, 0.5, 1}),
         .apply = applyRoughness,
         .variants = {{"shading-precision", "fp16"}},
         .because = "roughness is clamped to at least 0.045, where D is at most 8e4"},
        {.name = "normal_map",
         .what = "the strength of every normal map",
         .magnitudes = ladder(1e-3, 1e9),
         .lacks = {lacksNormalMap},
         .apply = applyNormalMap,
         .fails_at = 0x1p63,
         .because = "squares of the mapped normal's components are float32, which ends at 3e38"},
        {.name = "texel",
         .what = "every texel of every texture except alpha, as a fraction of its type's largest value",
         .magnitudes = {0, 1e-5, 1 / 255.0, 2 / 255.0, 0.05, 0.2, 0.5, 254 / 255.0, 1},
         .lacks = {lacksTexture},
         .apply = applyTexel,
         .because = "an integer texel is 0 to 1 in at most 16 bits, and a normal map of one "
                    "value is one direction"},
        {.name = "emission",
         .unit = "W/(sr m^2)",
         .what = "the emission of every surface",
         .magnitudes = ladder(1e-12, 1e38, 100),
         .apply = applyEmission,
         .fails_at = 3.4e38,
         .because = "emission is float32, which ends at 3.4e38"},
        {.name = "color",
         .what = "the colour of every vertex, replacing its own",
         .magnitudes = ladder(1e-38, 1, 100),
         .apply = applyColor,
         .because = "a base colour too dark for float32 adds nothing visible to the specular reflection"},
        {.name = "shadow_depth",
         .unit = "m",
         .what = "distance of an additional small shadow caster beyond the scene, towards the sun",
         .magnitudes = ladder(1, 1e8),
         .original = [](const Subject& subject) { return subject.radius(); },
         .lacks = {lacksSun},
         .apply = applyCaster,
         .variants = {{"shadows", "evsm"}, {"shadows", "msm4"}},
         .predict = predictCaster},
        {.name = "evsm_exponent",
         .what = "the positive exponent of 32-bit exponential variance shadow maps",
         .magnitudes = {1, 2, 5, 10, 20, 30, 40, 44, 44.36},
         .original = [](const Subject&) { return 10.0; },
         .lacks = {lacksSun},
         .apply = applyExponent,
         .fails_at = 44.36,
         .because = "the second moment is at most exp(2 x 44.36), the end of float32"},
        {.name = "haze",
         .what = "the density of haze",
         .magnitudes = ladder(1e-9, 1e9),
         .apply = applyHaze,
         .variants = {{"haze-march-steps", "32"}},
         .predict = predictHaze},
    };
}

}  // namespace diptych::audit
