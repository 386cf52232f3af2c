// SPDX-License-Identifier: MIT
// The test scene of clear coats, anisotropy, sheen and iridescence.
#include "shared/scene/builtin/builder.h"
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <string>

namespace diptych::builtin {
namespace {

// Two blocks side by side: coats and anisotropy, then sheen and iridescence.
constexpr int rows = 6, columns = 6;

// Textures of the layers.
struct Maps {
    TextureSlot relief, ripples, coat, brushed, sheen, film;
};

Maps addMaps(Builder& b) {
    return {b.texture(normalMap("relief", weaveHeights(128), 10), 2),
            b.texture(normalMap("ripples", tileHeights(128), 5), 2),
            // weight in R, roughness in G
            b.texture(checker("coat", 128, 8, {255, 40, 0, 255}, {110, 190, 0, 255}), 2),
            // along the tangent at full strength; along the bitangent at less
            b.texture(checker("brushed", 128, 8, {255, 128, 255, 255}, {128, 255, 170, 255}), 2),
            // colour in RGB, roughness in A
            b.texture(checker("sheen", 128, 8, {255, 188, 90, 255}, {70, 120, 255, 100}), 2),
            // weight in R, thickness in G
            b.texture(checker("film", 128, 8, {255, 255, 0, 255}, {120, 30, 0, 255}), 2)};
}

Material dielectric(const glm::vec3& color, float roughness) {
    Material m;
    m.base_color = glm::vec4(color, 1);
    m.metallic = 0;
    m.roughness = roughness;
    return m;
}
Material metal() {
    Material m;
    m.base_color = {0.8f, 0.7f, 0.55f, 1};
    m.roughness = 0.3f;
    return m;
}

// A ball of one row of the first block; `t` grows from 0 to 1 along it.
Material coatedOrBrushed(int row, float t, const Maps& maps) {
    Material m = row < 2 ? dielectric({0.5f, 0.03f, 0.03f}, 0.7f) : metal();
    switch (row) {
        case 0:
            m.clearcoat = t;
            m.clearcoat_roughness = 0.1f;
            break;
        case 1:
            m.clearcoat = 1;
            m.clearcoat_roughness = t;
            break;
        case 2:
            m.clearcoat = 1;
            m.clearcoat_roughness = 0.1f;
            m.normal_texture = maps.relief;
            if (t > 0.5f) m.clearcoat_normal_texture = maps.ripples;
            m.clearcoat_normal_scale = t;
            break;
        case 3:
            m.anisotropy = t;
            break;
        case 4:
            m.anisotropy = 0.8f;
            m.anisotropy_rotation = t * glm::radians(90.0f);
            break;
        default:
            m.anisotropy = 1 - 0.5f * t;
            m.anisotropy_rotation = t * glm::radians(45.0f);
            m.anisotropy_texture = maps.brushed;
            m.clearcoat = 1;
            m.clearcoat_roughness = 0.2f + 0.8f * t;
            m.clearcoat_texture = m.clearcoat_roughness_texture = maps.coat;
            break;
    }
    return m;
}

// The same of the second block.
Material clothOrFilm(int row, float t, const Maps& maps) {
    Material m = row < 2    ? dielectric({0.03f, 0.01f, 0.05f}, 0.9f)
                 : row == 3 ? metal()
                            : dielectric({0.02f, 0.02f, 0.02f}, 0.3f);
    const auto film = [&](float weight, float ior, float thickness) {
        m.iridescence = weight;
        m.iridescence_ior = ior;
        m.iridescence_thickness_most = thickness;
    };
    switch (row) {
        case 0:
            m.sheen_color = t * glm::vec3(0.9f, 0.6f, 1);
            m.sheen_roughness = 0.4f;
            break;
        case 1:
            m.sheen_color = {0.9f, 0.6f, 1};
            m.sheen_roughness = t;
            break;
        case 2:
            film(1, 1.8f, 100 + 900 * t);
            break;
        case 3:
            film(t, 1.2f + t, 400);
            break;
        case 4:
            m.sheen_color = glm::vec3(1 - 0.5f * t);
            m.sheen_roughness = 0.3f + 0.7f * t;
            m.sheen_color_texture = m.sheen_roughness_texture = maps.sheen;
            film(1 - 0.5f * t, 1.5f + t, 800);
            m.iridescence_thickness_least = 400 * t;
            m.iridescence_texture = m.iridescence_thickness_texture = maps.film;
            break;
        default:
            m.metallic = t;
            m.anisotropy = 0.7f;
            m.clearcoat = 0.8f;
            m.clearcoat_roughness = 0.1f;
            m.sheen_color = {0.2f, 0.5f, 0.3f};
            m.sheen_roughness = 0.2f + 0.6f * t;
            film(0.8f, 1.4f, 300 + 300 * t);
            break;
    }
    return m;
}

}  // namespace

// Rows, from above. On the left: weight of a coat over a rough dielectric; its roughness; a smooth coat over
// a metal's normal map, on the right with a normal map of its own; strength of anisotropy on a metal; its
// rotation from 0 to 90 degrees; both layers, textured. On the right: colour of a sheen over dark cloth; its
// roughness; thickness of a film on a dark dielectric, 100 to 1000 nm; weight and index of a film on a metal;
// both, textured; a coat over sheen over film over stretched highlights.
Scene layers() {
    Builder b;
    // The frame holds both blocks; a narrower picture shows more above and below.
    b.camera("front", {0, 0.3, 14}, {0, 0, 0}, 29, 0.1, 100).aspect = 16.0 / 9;
    b.scene.background = glm::vec3(0.05f);
    const char* const names[2][rows] = {{"coat's weight", "coat's roughness", "coat over relief",
                                         "anisotropy strength", "anisotropy rotation", "both"},
                                        {"sheen's colour", "sheen's roughness", "film thickness",
                                         "film's weight and index", "textured sheen and film", "all"}};
    const Maps maps = addMaps(b);
    const Primitive ball = sphere(0.46, 28, 14);
    for (int block = 0; block < 2; ++block)
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const float t = static_cast<float>(column) / (columns - 1);
                Material material = block == 0 ? coatedOrBrushed(row, t, maps) : clothOrFilm(row, t, maps);
                material.name = fmt::format("{} {:.1f}", names[block][row], t);
                const int index = static_cast<int>(b.scene.materials.size());
                b.scene.materials.push_back(material);
                b.add(material.name, ball, index,
                      glm::dvec3(column - 2.5 + (block == 0 ? -3.25 : 3.25), 2.5 - row, 0));
            }
    b.sun({-0.4, -0.8, -0.6}, glm::vec3(1), 2);
    b.point({-4, 3, 5}, {1.0f, 0.75f, 0.5f}, 40, 20);
    b.point({5, -2, 4}, {0.5f, 0.7f, 1.0f}, 30, 20);
    return std::move(b.scene);
}

}  // namespace diptych::builtin
