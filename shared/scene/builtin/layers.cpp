// SPDX-License-Identifier: MIT
// The test scene of clear coats and anisotropy.
#include "shared/scene/builtin/builder.h"
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <string>

namespace diptych::builtin {
namespace {

constexpr int columns = 6;

// Textures of the layers.
struct Maps {
    TextureSlot relief, ripples, coat, brushed;
};

Maps addMaps(Builder& b) {
    return {b.texture(normalMap("relief", weaveHeights(128), 10), 2),
            b.texture(normalMap("ripples", tileHeights(128), 5), 2),
            // weight in R, roughness in G
            b.texture(checker("coat", 128, 8, {255, 40, 0, 255}, {110, 190, 0, 255}), 2),
            // along the tangent at full strength; along the bitangent at less
            b.texture(checker("brushed", 128, 8, {255, 128, 255, 255}, {128, 255, 170, 255}), 2)};
}

// A ball of one row; `t` grows from 0 to 1 along it.
Material ballOf(int row, float t, const Maps& maps) {
    Material m;
    const bool metal = row >= 2;
    m.base_color = metal ? glm::vec4(0.8f, 0.7f, 0.55f, 1) : glm::vec4(0.5f, 0.03f, 0.03f, 1);
    m.metallic = metal ? 1.0f : 0.0f;
    m.roughness = metal ? 0.3f : 0.7f;
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

}  // namespace

// Rows, from above: weight of a coat over a rough dielectric; its roughness; a smooth coat over a metal's
// normal map, on the right with a normal map of its own; strength of anisotropy on a metal; its rotation
// from 0 to 90 degrees; both layers, textured.
Scene layers() {
    Builder b;
    b.camera("front", {0, 0.3, 12}, {0, 0, 0}, 30, 0.1, 100);
    b.scene.background = glm::vec3(0.05f);
    const char* const rows[] = {"coat's weight",       "coat's roughness",    "coat over relief",
                                "anisotropy strength", "anisotropy rotation", "both"};
    const Maps maps = addMaps(b);
    const Primitive ball = sphere(0.46, 40, 20);
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < columns; ++column) {
            const float t = static_cast<float>(column) / (columns - 1);
            Material material = ballOf(row, t, maps);
            material.name = fmt::format("{} {:.1f}", rows[row], t);
            b.scene.materials.push_back(material);
            b.add(material.name, ball, row * columns + column, glm::dvec3(column - 2.5, 2.5 - row, 0));
        }
    b.sun({-0.4, -0.8, -0.6}, glm::vec3(1), 2);
    b.point({-4, 3, 5}, {1.0f, 0.75f, 0.5f}, 40, 20);
    b.point({5, -2, 4}, {0.5f, 0.7f, 1.0f}, 30, 20);
    return std::move(b.scene);
}

}  // namespace diptych::builtin
