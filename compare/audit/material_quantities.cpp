// SPDX-License-Identifier: MIT
#include "compare/audit/groups.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace diptych::audit {

namespace {

void pushRoughness(Case& pushed, const Subject&, double roughness) {
    for (Material& material : pushed.scene.materials) material.roughness = static_cast<float>(roughness);
}

double originalRoughness(const Subject&) {
    return 1;
}

std::string lacksNormalMap(const Subject& subject) {
    const bool any = std::ranges::any_of(subject.given.scene.materials, [](const Material& material) {
        return material.normal_texture.texture >= 0;
    });
    return any ? "" : "no material has a normal map";
}

void pushNormalMap(Case& pushed, const Subject&, double strength) {
    for (Material& material : pushed.scene.materials)
        if (material.normal_texture.texture >= 0) material.normal_scale = static_cast<float>(strength);
}

// Replaces every surface's emission.
void pushEmission(Case& pushed, const Subject&, double radiance) {
    const auto sent = static_cast<float>(std::min(radiance, double{std::numeric_limits<float>::max()}));
    for (Material& material : pushed.scene.materials) material.emissive = glm::vec3(sent);
    for (auto& [index, parts] : pushed.scene.material_parts) {
        parts.emissive = glm::dvec3(1);
        parts.emissive_strength = radiance;
    }
}

// Sets every vertex colour, beside the material's colour.
void pushColor(Case& pushed, const Subject&, double factor) {
    for (Mesh& mesh : pushed.scene.meshes)
        for (Primitive& primitive : mesh.primitives)
            primitive.colors.assign(primitive.positions.size(),
                                    glm::vec4(glm::vec3(static_cast<float>(factor)), 1));
}

std::string lacksTexture(const Subject& subject) {
    return subject.given.scene.images.empty() ? "no material has a texture" : "";
}

// Colours, normals and all else; keeps alpha, which decides where a surface is.
template <class Value>
void setTexels(std::vector<Value>& texels, Value value) {
    for (std::size_t i = 0; i < texels.size(); ++i)
        if (i % 4 != 3) texels[i] = value;
}

void pushTexel(Case& pushed, const Subject&, double share) {
    for (TextureImage& image : pushed.scene.images) {
        setTexels(image.rgba, static_cast<std::uint8_t>(std::lround(share * 0xFF)));
        setTexels(image.rgba16, static_cast<std::uint16_t>(std::lround(share * 0xFFFF)));
        setTexels(image.rgba32, static_cast<float>(share) * image.largest);
    }
}

Predicted predictTexel(const Subject&, const Settings&, double) {
    return {
        .because =
            "an integer texel is 0 to 1 in at most 16 bits, and a normal map of one value is one direction"};
}

Predicted predictRoughness(const Subject&, const Settings&, double) {
    return {.because = "roughness is clamped to at least 0.045, where D is at most 8e4"};
}

Predicted predictNormalMap(const Subject&, const Settings&, double) {
    return {.up = 0x1p63,
            .because = "squares of the mapped normal's components are float32, which ends at 3e38"};
}

Predicted predictEmission(const Subject&, const Settings&, double) {
    return {.up = 3.4e38, .because = "emission is float32, which ends at 3.4e38"};
}

Predicted predictColor(const Subject&, const Settings&, double) {
    return {.because = "a base colour too dark for float32 adds nothing visible to the specular reflection"};
}

}  // namespace

std::vector<Quantity> materialQuantities() {
    std::vector<double> roughnesses = ladder(1e-6, 1e-2);
    roughnesses.insert(roughnesses.begin(), 0);
    for (const double rough : {0.02, 0.03, 0.045, 0.06, 0.1, 0.2, 0.5, 1.0}) roughnesses.push_back(rough);
    return {{.name = "roughness",
             .unit = "",
             .what = "the roughness factor of every material",
             .magnitudes = roughnesses,
             .original = originalRoughness,
             .lacks = lacksNothing,
             .push = pushRoughness,
             .variants = {{"shading-precision", "fp16"}},
             .predict = predictRoughness},
            {.name = "normal_map",
             .unit = "",
             .what = "the strength of every normal map",
             .magnitudes = ladder(1e-3, 1e9),
             .original = originalOne,
             .lacks = lacksNormalMap,
             .push = pushNormalMap,
             .predict = predictNormalMap},
            {.name = "texel",
             .unit = "",
             .what = "every texel of every texture except alpha, as a fraction of its type's largest value",
             .magnitudes = {0, 1e-5, 1 / 255.0, 2 / 255.0, 0.05, 0.2, 0.5, 254 / 255.0, 1},
             .original = originalOne,
             .lacks = lacksTexture,
             .push = pushTexel,
             .predict = predictTexel},
            {.name = "emission",
             .unit = "W/(sr m^2)",
             .what = "the emission of every surface",
             .magnitudes = ladder(1e-12, 1e38, 100),
             .original = originalOne,
             .lacks = lacksNothing,
             .push = pushEmission,
             .predict = predictEmission},
            {.name = "color",
             .unit = "",
             .what = "the colour of every vertex, replacing its own",
             .magnitudes = ladder(1e-38, 1, 100),
             .original = originalOne,
             .lacks = lacksNothing,
             .push = pushColor,
             .predict = predictColor}};
}

}  // namespace diptych::audit
