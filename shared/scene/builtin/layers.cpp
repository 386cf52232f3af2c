// SPDX-License-Identifier: MIT
// Test scenes of the layers over and within the base, and of light through surfaces: rows of balls.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <span>
#include <string>

namespace diptych::builtin {
namespace {

// Textures of the material layers. A scene makes only the textures that its rows read.
struct Maps {
    TextureSlot relief = {}, ripples = {}, coat = {}, brushed = {}, sheen = {}, film = {};
    TextureSlot transmission = {}, thickness = {}, diffuse = {};
};

struct BallRow {
    const char* name;
    Surface surface;
    // `t` grows from 0 to 1 along the row.
    void (*change)(Material&, float t, const Maps&);
};

void addRows(Builder& b, std::span<const BallRow> rows, const Maps& maps, int balls, double step, double x) {
    const Primitive ball = sphere(0.46, 28, 14);
    double y = 2.5;
    for (const BallRow& row : rows) {
        for (int i = 0; i < balls; ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(balls - 1);
            const std::string name = fmt::format("{} {:.1f}", row.name, t);
            const int material = b.material(name, row.surface);
            row.change(b.last(), t, maps);
            b.add(name, ball, material, glm::dvec3(step * (i - 0.5 * (balls - 1)) + x, y, 0));
        }
        y -= 1;
    }
}

void coat(Material& m, float weight, float roughness) {
    m.clearcoat = weight;
    m.clearcoat_roughness = roughness;
}
void brush(Material& m, float strength, float rotation) {
    m.anisotropy = strength;
    m.anisotropy_rotation = rotation;
}
void sheen(Material& m, const glm::vec3& color, float roughness) {
    m.sheen_color = color;
    m.sheen_roughness = roughness;
}
void film(Material& m, float weight, float ior, float thickness) {
    m.iridescence = weight;
    m.iridescence_ior = ior;
    m.iridescence_thickness_max = thickness;
}
void slab(Material& m, float thickness) {
    m.transmission = 1;
    m.thickness = thickness;
}

constexpr Surface lacqueredBase{{0.5f, 0.03f, 0.03f}, 0, 0.7f}, metalBase{{0.8f, 0.7f, 0.55f}, 1, 0.3f},
    clothBase{{0.03f, 0.01f, 0.05f}, 0, 0.9f}, darkBase{{0.02f, 0.02f, 0.02f}, 0, 0.3f},
    glassBase{{0.95f, 0.97f, 1}, 0, 0.05f};

const BallRow coatedOrBrushed[] = {
    {"coat's weight", lacqueredBase, [](Material& m, float t, const Maps&) { coat(m, t, 0.1f); }},
    {"coat's roughness", lacqueredBase, [](Material& m, float t, const Maps&) { coat(m, 1, t); }},
    {"coat over relief", metalBase,
     [](Material& m, float t, const Maps& maps) {
         coat(m, 1, 0.1f);
         m.normal_texture = maps.relief;
         if (t > 0.5f) m.clearcoat_normal_texture = maps.ripples;
         m.clearcoat_normal_scale = t;
     }},
    {"anisotropy strength", metalBase, [](Material& m, float t, const Maps&) { brush(m, t, 0); }},
    {"anisotropy rotation", metalBase,
     [](Material& m, float t, const Maps&) { brush(m, 0.8f, t * glm::radians(90.0f)); }},
    {"both", metalBase,
     [](Material& m, float t, const Maps& maps) {
         brush(m, 1 - 0.5f * t, t * glm::radians(45.0f));
         coat(m, 1, 0.2f + 0.8f * t);
         m.anisotropy_texture = maps.brushed;
         m.clearcoat_texture = m.clearcoat_roughness_texture = maps.coat;
     }},
};

const BallRow clothOrFilm[] = {
    {"sheen's colour", clothBase,
     [](Material& m, float t, const Maps&) { sheen(m, t * glm::vec3(0.9f, 0.6f, 1), 0.4f); }},
    {"sheen's roughness", clothBase,
     [](Material& m, float t, const Maps&) {
         sheen(m, {0.9f, 0.6f, 1}, t);
     }},
    {"film thickness", darkBase, [](Material& m, float t, const Maps&) { film(m, 1, 1.8f, 100 + 900 * t); }},
    {"film's weight and index", metalBase,
     [](Material& m, float t, const Maps&) { film(m, t, 1.2f + t, 400); }},
    {"textured sheen and film", darkBase,
     [](Material& m, float t, const Maps& maps) {
         sheen(m, glm::vec3(1 - 0.5f * t), 0.3f + 0.7f * t);
         m.sheen_color_texture = m.sheen_roughness_texture = maps.sheen;
         film(m, 1 - 0.5f * t, 1.5f + t, 800);
         m.iridescence_thickness_min = 400 * t;
         m.iridescence_texture = m.iridescence_thickness_texture = maps.film;
     }},
    {"all", darkBase,
     [](Material& m, float t, const Maps&) {
         m.metallic = t;
         brush(m, 0.7f, 0);
         coat(m, 0.8f, 0.1f);
         sheen(m, {0.2f, 0.5f, 0.3f}, 0.2f + 0.6f * t);
         film(m, 0.8f, 1.4f, 300 + 300 * t);
     }},
};

const BallRow transmitting[] = {
    {"transmission", glassBase,
     [](Material& m, float t, const Maps&) {
         m.transmission = t;
         m.metallic = t > 0.9f ? 0.5f : 0;
     }},
    {"rough transmission", glassBase,
     [](Material& m, float t, const Maps&) {
         slab(m, 0);
         m.roughness = t;
     }},
    {"slab", glassBase,
     [](Material& m, float t, const Maps&) {
         slab(m, t);
         m.ior = 1 + 1.5f * t;
         m.roughness = 0.4f * t;
     }},
    {"absorption", glassBase,
     [](Material& m, float t, const Maps&) {
         slab(m, 0.8f);
         m.attenuation_color = {0.2f + 0.6f * t, 0.7f, 0.9f - 0.7f * t};
         m.attenuation_distance = 0.2f + 2 * t;
         m.dispersion = 5 * t;
     }},
    {"diffuse transmission",
     {{0.3f, 0.25f, 0.1f}, 0, 0.8f},
     [](Material& m, float t, const Maps&) {
         m.diffuse_transmission = t;
         m.diffuse_transmission_color = {0.5f, 0.9f, 0.2f};
     }},
    {"all", glassBase,
     [](Material& m, float t, const Maps& maps) {
         slab(m, 0.5f);
         m.transmission = 1 - 0.4f * t;
         coat(m, t, 0.2f);
         sheen(m, glm::vec3(0.4f * t), 0.5f);
         film(m, t, m.iridescence_ior, 500);
         m.diffuse_transmission = 0.5f * t;
         m.transmission_texture = maps.transmission;
         m.thickness_texture = maps.thickness;
         m.diffuse_transmission_texture = m.diffuse_transmission_color_texture = maps.diffuse;
         if (t > 0.8f) {
             m.alpha_mode = AlphaMode::blend;
             m.base_color.a = 0.6f;
         }
     }},
};

}  // namespace

// Rows, from above. On the left: weight of a coat over a rough dielectric; its roughness; a smooth coat over
// a metal's normal map, on the right with a normal map of its own; strength of anisotropy on a metal; its
// rotation from 0 to 90 degrees; both layers, textured. On the right: colour of a sheen over dark cloth; its
// roughness; thickness of a film on a dark dielectric, 100 to 1000 nm; weight and index of a film on a metal;
// both, textured; a coat over sheen over film over stretched highlights.
void layers(Builder& b) {
    // The frame holds both blocks; a narrower image shows more above and below.
    b.camera("front", {0, 0.3, 14}, {0, 0, 0}, 29, 0.1, 100).aspect = 16.0 / 9;
    b.scene.background = glm::vec3(0.05f);
    const Maps maps{
        .relief = b.texture(normalMap("relief", weaveHeights(128), 10), 2),
        .ripples = b.texture(normalMap("ripples", tileHeights(128), 5), 2),
        // weight in R, roughness in G
        .coat = b.texture(checker("coat", 128, 8, {255, 40, 0, 255}, {110, 190, 0, 255}), 2),
        // along the tangent at full strength; along the bitangent at less
        .brushed = b.texture(checker("brushed", 128, 8, {255, 128, 255, 255}, {128, 255, 170, 255}), 2),
        // colour in RGB, roughness in A
        .sheen = b.texture(checker("sheen", 128, 8, {255, 188, 90, 255}, {70, 120, 255, 100}), 2),
        // weight in R, thickness in G
        .film = b.texture(checker("film", 128, 8, {255, 255, 0, 255}, {120, 30, 0, 255}), 2)};
    addRows(b, coatedOrBrushed, maps, 6, 1, -3.25);
    addRows(b, clothOrFilm, maps, 6, 1, 3.25);
    b.sun({-0.4, -0.8, -0.6}, glm::vec3(1), 2);
    b.point({-4, 3, 5}, {1.0f, 0.75f, 0.5f}, 40, 20);
    b.point({5, -2, 4}, {0.5f, 0.7f, 1.0f}, 30, 20);
}

// Rows of balls before a chequered wall, from above: weight of transmission through thin walls; their
// roughness; thickness, index and roughness of slabs; colour and distance of absorption, and dispersion;
// weight of diffuse transmission, lit from behind; everything textured under a coat, a sheen and a film.
void transmission(Builder& b) {
    b.camera("front", {0, 0, 12}, {0, 0, 0}, 32, 0.1, 100).aspect = 16.0 / 9;
    b.scene.background = glm::vec3(0.1f);
    const Maps maps{
        // transmission in R
        .transmission = b.texture(checker("transmission", 64, 4, {255, 0, 0, 255}, {60, 0, 0, 255}), 2),
        // thickness in G
        .thickness = b.texture(checker("thickness", 64, 4, {0, 255, 0, 255}, {0, 50, 0, 255}), 2),
        // colour in RGB, weight in A
        .diffuse = b.texture(checker("leaf", 64, 4, {90, 255, 60, 255}, {255, 200, 90, 120}), 2)};
    addRows(b, transmitting, maps, 8, 1.15, 0);
    const int wall = b.material("wall", {glm::vec3(1), 0, 0.9f});
    b.last().base_color_texture =
        b.texture(checker("wall", 256, 32, {230, 225, 215, 255}, {40, 60, 110, 255}), 2);
    b.add("wall", quad({-8, -5, -1.5}, {16, 0, 0}, {0, 10, 0}), wall);
    b.sun({-0.4, -0.8, -0.6}, glm::vec3(1), 2);
    b.point({-4, 3, 5}, {1.0f, 0.75f, 0.5f}, 40, 20);
    b.point({4, -1.5, -1}, {0.6f, 0.8f, 1.0f}, 20, 20);  // behind the balls
    b.point({-4, -1.5, -1}, {1.0f, 0.9f, 0.7f}, 20, 20);
}

}  // namespace diptych::builtin
