// SPDX-License-Identifier: MIT
// The test scene of transmission, volume, dispersion and diffuse transmission.
#include "shared/scene/builtin/builder.h"
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>

#include <string>

namespace diptych::builtin {
namespace {

constexpr int rows = 6, columns = 8;

// Textures of the surfaces.
struct Maps {
    TextureSlot transmission, thickness, diffuse;
};

Maps addMaps(Builder& b) {
    return {// transmission in R
            b.texture(checker("transmission", 64, 4, {255, 0, 0, 255}, {60, 0, 0, 255}), 2),
            // thickness in G
            b.texture(checker("thickness", 64, 4, {0, 255, 0, 255}, {0, 50, 0, 255}), 2),
            // colour in RGB, weight in A
            b.texture(checker("leaf", 64, 4, {90, 255, 60, 255}, {255, 200, 90, 120}), 2)};
}

Material glass() {
    Material m;
    m.base_color = {0.95f, 0.97f, 1, 1};
    m.metallic = 0;
    m.roughness = 0.05f;
    m.transmission = 1;
    return m;
}

// A ball of one row; `t` grows from 0 to 1 along it.
Material materialOf(int row, float t, const Maps& maps) {
    Material m = glass();
    switch (row) {
        case 0:
            m.transmission = t;
            m.metallic = t > 0.9f ? 0.5f : 0;
            break;
        case 1:
            m.roughness = t;
            break;
        case 2:
            m.thickness = t;
            m.ior = 1 + 1.5f * t;
            m.roughness = 0.4f * t;
            break;
        case 3:
            m.thickness = 0.8f;
            m.attenuation_color = {0.2f + 0.6f * t, 0.7f, 0.9f - 0.7f * t};
            m.attenuation_distance = 0.2f + 2 * t;
            m.dispersion = 5 * t;
            break;
        case 4:
            m.roughness = 0.8f;
            m.base_color = {0.3f, 0.25f, 0.1f, 1};
            m.transmission = 0;
            m.diffuse_transmission = t;
            m.diffuse_transmission_color = {0.5f, 0.9f, 0.2f};
            break;
        default:
            m.transmission = 1 - 0.4f * t;
            m.thickness = 0.5f;
            m.clearcoat = t;
            m.clearcoat_roughness = 0.2f;
            m.sheen_color = glm::vec3(0.4f * t);
            m.sheen_roughness = 0.5f;
            m.iridescence = t;
            m.iridescence_thickness_most = 500;
            m.diffuse_transmission = 0.5f * t;
            m.transmission_texture = maps.transmission;
            m.thickness_texture = maps.thickness;
            m.diffuse_transmission_texture = m.diffuse_transmission_color_texture = maps.diffuse;
            if (t > 0.8f) {
                m.alpha_mode = AlphaMode::blend;
                m.base_color.a = 0.6f;
            }
            break;
    }
    return m;
}

}  // namespace

// Rows of balls before a chequered wall, from above: weight of transmission through thin walls; their
// roughness; thickness, index and roughness of slabs; colour and distance of absorption, and dispersion;
// weight of diffuse transmission, lit from behind; everything textured under a coat, a sheen and a film.
Scene transmission() {
    Builder b;
    b.camera("front", {0, 0, 12}, {0, 0, 0}, 32, 0.1, 100).aspect = 16.0 / 9;
    b.scene.background = glm::vec3(0.1f);
    const char* const names[rows] = {"transmission", "rough transmission",   "slab",
                                     "absorption",   "diffuse transmission", "all"};
    const Maps maps = addMaps(b);
    const Primitive ball = sphere(0.46, 28, 14);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const float t = static_cast<float>(column) / (columns - 1);
            Material material = materialOf(row, t, maps);
            material.name = fmt::format("{} {:.1f}", names[row], t);
            const int index = static_cast<int>(b.scene.materials.size());
            b.scene.materials.push_back(material);
            b.add(material.name, ball, index, glm::dvec3(1.15 * (column - 3.5), 2.5 - row, 0));
        }
    const int wall = b.material("wall", {glm::vec3(1), 0, 0.9f});
    b.scene.materials.back().base_color_texture =
        b.texture(checker("wall", 256, 32, {230, 225, 215, 255}, {40, 60, 110, 255}), 2);
    b.add("wall", quad({-8, -5, -1.5}, {16, 0, 0}, {0, 10, 0}), wall, glm::dvec3(0.0));
    b.sun({-0.4, -0.8, -0.6}, glm::vec3(1), 2);
    b.point({-4, 3, 5}, {1.0f, 0.75f, 0.5f}, 40, 20);
    b.point({4, -1.5, -1}, {0.6f, 0.8f, 1.0f}, 20, 20);  // behind the balls
    b.point({-4, -1.5, -1}, {1.0f, 0.9f, 0.7f}, 20, 20);
    return std::move(b.scene);
}

}  // namespace diptych::builtin
