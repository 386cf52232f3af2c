// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/gallery.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <cmath>

namespace diptych::builtin {
namespace {

// Spheres, metallic by roughness: ceramics in front, metallic 0.5 in the middle, gold behind.
void stage(Room& room) {
    Builder& b = room.b;
    const vec3 colors[] = {{0.02f, 0.26f, 0.3f}, {0.72f, 0.2f, 0.16f}, {1.0f, 0.72f, 0.32f}};
    const char* names[] = {"ceramic", "lacquer", "gold"};
    for (int row = 0; row < 3; ++row) {
        const double height = 0.45 + 0.38 * row, z = STAGE.z + 0.75 - 0.75 * row;
        b.add("step", box({2 * STAGE.half_x, height, 0.8}, 0.02), room.stone, dvec3(STAGE.x, height / 2, z));
        for (int column = 0; column < 7; ++column) {
            const float roughness = 0.1f + 0.15f * static_cast<float>(column);
            const int material = b.material(fmt::format("{} {:.2f}", names[row], roughness),
                                            {colors[row], 0.5f * static_cast<float>(row), roughness});
            b.add("ball", sphere(0.26, 48, 24), material,
                  dvec3(STAGE.x + 0.7 * (column - 3), height + 0.26, z));
        }
    }
}

Primitive pedestal(double radius, double height) {
    return lathe(
        {dvec2(0, 0), dvec2(radius, 0), dvec2(radius, 0.1), dvec2(radius * 0.86, 0.16),
         dvec2(radius * 0.78, 0.2), dvec2(radius * 0.76, height - 0.16), dvec2(radius * 0.82, height - 0.1),
         dvec2(radius * 0.94, height - 0.07), dvec2(radius * 0.94, height), dvec2(0, height)},
        48);
}

void sculptures(Room& room) {
    Builder& b = room.b;
    // At the end of the hall: a knot in front of a ring of light.
    b.add("tall pedestal", pedestal(0.6, 1.5), room.stone, dvec3(KNOT.x, 0, KNOT.z));
    const int copper = b.material("brushed copper", {{0.95f, 0.56f, 0.4f}, 1, 1});
    b.last().metallic_roughness_texture = b.texture(brushed("brushed", 256), 3);
    b.add("knot", torusKnot(2, 3, 0.5, 0.24, 0.13), copper,
          at(KNOT.x, 2.38, KNOT.z) * rotated(90, {1, 0, 0}));
    b.add("ring of light", torus(1.45, 0.06, 96, 16), room.glowing("cyan neon", CYAN * 5.0f),
          at(KNOT.x, 2.45, FAR_END + 0.35) * rotated(90, {1, 0, 0}));

    // Front right: a gem with ior 2.4 and a tinted specular colour.
    b.add("pedestal", pedestal(0.36, 0.92), room.stone, dvec3(GEM.x, 0, GEM.z));
    const int cut = b.material("cut stone", {{0.12f, 0.04f, 0.26f}, 0, 0.2f});
    b.last().ior = 2.4f;
    b.last().specular_color = {1.0f, 0.8f, 1.0f};
    b.add("cut stone", gem(0.56), cut, at(GEM.x, 0.9, GEM.z) * rotated(11));

    // Vertex colours show a glaze that runs down. The low specular strength suggests unglazed clay.
    const int glaze = b.material("glaze", {vec3(1), 0, 0.25f});
    b.last().specular = 0.6f;
    const Primitive vase =
        lathe({dvec2(0, 0), dvec2(0.16, 0), dvec2(0.2, 0.06), dvec2(0.3, 0.26), dvec2(0.33, 0.42),
               dvec2(0.29, 0.58), dvec2(0.17, 0.74), dvec2(0.1, 0.86), dvec2(0.1, 0.96), dvec2(0.15, 1.04),
               dvec2(0.13, 1.04), dvec2(0.08, 0.95), dvec2(0.08, 0.86)},
              64);
    b.add("vase",
          paint(vase,
                [](const vec3& p) {
                    const float run = 0.52f + 0.09f * std::sin(9 * std::atan2(p.x, p.z)) +
                                      0.04f * std::sin(23 * std::atan2(p.z, p.x));
                    return glm::vec4(glm::mix(vec3(0.5f, 0.3f, 0.16f), vec3(0.05f, 0.32f, 0.4f),
                                              glm::smoothstep(run - 0.06f, run + 0.06f, p.y)),
                                     1);
                }),
          glaze, dvec3(VASE.x, 0.75, VASE.z));
    b.add("low pedestal", pedestal(0.42, 0.75), room.stone, dvec3(VASE.x, 0, VASE.z));
}

// Alpha-tested, on both sides.
int pierced(Builder& b, const std::string& name, const Surface& surface, TextureImage image,
            const Sampler& sampler = {}) {
    const int made = b.material(name, surface);
    b.last().base_color_texture = b.texture(std::move(image), 1, sampler);
    b.last().alpha_mode = AlphaMode::mask;
    b.last().double_sided = true;
    return made;
}

void greenery(Room& room) {
    Builder& b = room.b;
    const int pot = b.material("terracotta", {{0.42f, 0.17f, 0.09f}, 0, 0.8f});
    b.last().normal_texture = b.texture(normalMap("weave", weaveHeights(256), 14));
    b.last().normal_texture.u.x = 6;
    b.add(
        "planter",
        lathe(
            {{0, 0}, {0.3, 0}, {0.4, 0.62}, {0.42, 0.62}, {0.42, 0.7}, {0.36, 0.7}, {0.34, 0.58}, {0, 0.58}},
            48),
        pot, dvec3(PLANTER.x, 0, PLANTER.z));
    const int green = pierced(b, "leaf", {vec3(1), 0, 0.42f}, leaf("leaf", 256),
                              {.wrap_s = Wrap::clamp_to_edge, .wrap_t = Wrap::clamp_to_edge});
    Primitive leaves;
    // Leaves are at multiples of the golden angle; inner ones are steeper and longer.
    for (int i = 0; i < 46; ++i) {
        const double t = i / 45.0, size = 0.62 + 0.5 * (1 - t);
        Primitive blade = quad({-0.28 * size, 0, 0}, {0.56 * size, 0, 0}, {0, size, 0}, 1, 6);
        // Bends the leaf along a circular arc with a radius of 1.5 leaf lengths.
        const float radius = 1.5f * static_cast<float>(size);
        for (std::size_t k = 0; k < blade.positions.size(); ++k) {
            const float angle = blade.positions[k].y / radius;
            blade.positions[k].y = radius * std::sin(angle);
            blade.positions[k].z = -radius * (1 - std::cos(angle));
            blade.normals[k] = {0, std::sin(angle), std::cos(angle)};
        }
        append(leaves, blade,
               rotated(137.50776 * i) * at(0, 0.06 * (1 - t), 0.02 + 0.16 * t) *
                   rotated(8 + 62 * t, {1, 0, 0}) * rotated(180));
    }
    b.add("leaves", leaves, green, dvec3(PLANTER.x, 0.58, PLANTER.z));

    const int lattices = pierced(b, "gilded lattice", {vec3(1), 0.4f, 0.45f}, lattice("lattice", 256));
    const Primitive railing = scaleTexcoords(quad({-1.1, 0, 0}, {2.2, 0, 0}, {0, 0.9, 0}), 2.2 / 0.6, 1.5);
    for (int i = 0; i < 5; ++i) {
        const glm::dmat4 inArch = at(RIGHT + 0.25, 0, NEAR_END - 1.6 - 3.2 * i) * rotated(-90);
        b.add("railing", railing, lattices, inArch);
        b.add("rail", box({2.2, 0.06, 0.1}, 0.01), room.brass, inArch * at(0, 0.93, 0));
    }
    for (int i = 0; i < 3; ++i) {  // a folding screen
        const double x = 2.5 + 0.62 * i, turn = i % 2 == 0 ? 28 : -28;
        b.add("screen", scaleTexcoords(quad({-0.35, 0, 0}, {0.7, 0, 0}, {0, 1.9, 0}), 1.05, 2.85), lattices,
              at(x, 0.06, -4.4) * rotated(turn));
        b.add("screen's frame", box({0.04, 2.0, 0.04}, 0.008), room.brass,
              at(x, 1.0, -4.4) * rotated(turn) * at(-0.35, 0, 0));
    }
}

}  // namespace

void addExhibits(Room& room) {
    stage(room);
    sculptures(room);
    greenery(room);
}

}  // namespace diptych::builtin
