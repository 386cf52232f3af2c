// SPDX-License-Identifier: MIT
// The first picture a newcomer sees: a sculpture hall in the evening. Metres; x to the right, the hall runs
// from the camera at z = 5 to the end wall at z = -10; the left wall is at x = -4.5, the arcade at x = 4.2.
#include "shared/scene/builtin/builder.h"
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace diptych::builtin {
namespace {

using glm::dvec3;
using glm::vec3;

constexpr double LEFT = -4.5, RIGHT = 4.2, NEAR_END = 6, FAR_END = -10, CEILING = 4.6;
constexpr vec3 WARM{1.0f, 0.62f, 0.32f}, COOL{0.42f, 0.66f, 1.0f}, CYAN{0.25f, 0.85f, 1.0f},
    ROSE{1.0f, 0.28f, 0.42f}, IVORY{1.0f, 0.86f, 0.7f};

// Where things stand on the floor: centre and half extents on x and z.
struct Footprint {
    double x, z, half_x, half_z;
};
constexpr Footprint STAGE{0.2, -2.9, 2.6, 1.15}, KNOT{0.2, -8.2, 0.55, 0.55}, GEM{2.05, 1.55, 0.34, 0.34},
    VASE{3.0, -0.9, 0.38, 0.38}, PLANTER{-2.75, 0.9, 0.42, 0.42};

struct Room {
    Builder b;
    int stone = 0, brass = 0, dark_wood = 0;

    int textured(const std::string& name, const Surface& surface, const TextureSlot& color,
                 const TextureSlot& normal) {
        const int made = b.material(name, surface);
        b.scene.materials.back().base_color_texture = color;
        b.scene.materials.back().normal_texture = normal;
        return made;
    }
    int glowing(const std::string& name, const vec3& radiance) {
        return b.material(name, {vec3(0.02f), 0, 0.5f, radiance});
    }
};

// How much of the sky above the floor is open beside what stands there, squared for looks: punctual lights
// cast no shadows, so the vertex colours ground the objects.
float openness(const vec3& p) {
    const auto near = [](double distance, double reach) {
        const double t = std::clamp(distance / reach, 0.0, 1.0);
        return static_cast<float>(t * (2 - t));
    };
    float open = 0.35f + 0.65f * near(std::min({p.x - LEFT, RIGHT - p.x, p.z - FAR_END}), 0.9);
    for (const Footprint& f : {STAGE, KNOT, GEM, VASE, PLANTER}) {
        const double dx = std::max(std::abs(p.x - f.x) - f.half_x, 0.0),
                     dz = std::max(std::abs(p.z - f.z) - f.half_z, 0.0);
        open *= 0.25f + 0.75f * near(std::hypot(dx, dz), 0.55);
    }
    return open;
}

void walls(Room& room) {
    Builder& b = room.b;
    const HeightField tiles = tileHeights(512), bricks = brickHeights(512), plaster = plasterHeights(256);

    const TextureSlot tileColor =
        b.texture(colorMap("tile colour", tiles, {40, 38, 40, 255}, {134, 132, 140, 255}, 4, 4, false, 90));
    const TextureSlot tileNormal = b.texture(normalMap("tile relief", tiles, 3));
    const int floor = room.textured("floor tiles", {vec3(1), 0, 1}, tileColor, tileNormal);
    b.scene.materials.back().metallic_roughness_texture =
        b.texture(colorMap("tile polish", tiles, {255, 230, 0, 255}, {255, 62, 0, 255}, 4, 4, false, 40));
    b.scene.materials.back().metallic = 0;
    const double length = NEAR_END - FAR_END, width = RIGHT - LEFT;
    Primitive ground = quad({LEFT, 0, NEAR_END}, {width, 0, 0}, {0, 0, -length}, 58, 106);
    ground = paint(std::move(ground), [](const vec3& p) { return glm::vec4(vec3(openness(p)), 1); });
    b.add("floor", scaleTexcoords(std::move(ground), width / 3.2, length / 3.2), floor, dvec3(0.0));

    const TextureSlot brickColor =
        b.texture(colorMap("brick colour", bricks, {96, 84, 76, 255}, {188, 112, 82, 255}, 4, 8, true, 110));
    const TextureSlot brickNormal = b.texture(normalMap("brick relief", bricks, 9));
    const int wall = room.textured("bricks", {vec3(1), 0, 0.75f}, brickColor, brickNormal);
    b.scene.materials.back().occlusion_texture = b.texture(occlusion("brick depths", bricks));
    b.add("brick wall",
          scaleTexcoords(quad({LEFT, 0, NEAR_END}, {0, 0, -length}, {0, CEILING, 0}), length / 1.6,
                         CEILING / 1.6),
          wall, dvec3(0.0));

    const TextureSlot soft = b.texture(normalMap("plaster relief", plaster, 12));
    const int endWall = b.material("plum plaster", {{0.2f, 0.1f, 0.14f}, 0, 0.7f});
    b.scene.materials.back().normal_texture = soft;
    b.add("end wall", scaleTexcoords(quad({LEFT, 0, FAR_END}, {width, 0, 0}, {0, CEILING, 0}), 6, 3), endWall,
          dvec3(0.0));
    const int arcade = b.material("sand plaster", {{0.55f, 0.47f, 0.38f}, 0, 0.65f});
    b.scene.materials.back().normal_texture = soft;
    for (int i = 0; i < 5; ++i)
        b.add("arch", archway(3.2, CEILING, 0.6, 2.2, 2.2, 32), arcade,
              at(RIGHT, 0, NEAR_END - 1.6 - 3.2 * i) * turned(-90));
    const int night = b.material("night", {{0.02f, 0.03f, 0.05f}, 0, 0.9f, {0.012f, 0.022f, 0.05f}});
    b.add("night", quad({RIGHT + 0.6, 0, FAR_END}, {0, 0, length}, {0, CEILING, 0}), night, dvec3(0.0));

    const int ceiling = b.material("ceiling", {{0.1f, 0.09f, 0.09f}, 0, 0.9f});
    b.add("ceiling", quad({LEFT, CEILING, FAR_END}, {width, 0, 0}, {0, 0, length}), ceiling, dvec3(0.0));
    for (int i = 0; i < 8; ++i) {
        const double z = NEAR_END - 1.6 - 2.0 * i;
        b.add("beam", box({width, 0.34, 0.26}, 0.03), room.dark_wood,
              dvec3((LEFT + RIGHT) / 2, CEILING - 0.17, z));
        if (i % 2 == 0)
            b.add("pilaster", box({0.3, CEILING, 0.55}, 0.03), room.stone,
                  dvec3(LEFT + 0.12, CEILING / 2, z));
    }
}

// Metallic by roughness: ceramics in front, gold behind, half of each between.
void stage(Room& room) {
    Builder& b = room.b;
    const vec3 colors[] = {{0.02f, 0.26f, 0.3f}, {0.72f, 0.2f, 0.16f}, {1.0f, 0.72f, 0.32f}};
    const char* names[] = {"ceramic", "lacquer", "gold"};
    for (int row = 0; row < 3; ++row) {
        const double height = 0.45 + 0.38 * row, z = STAGE.z + 0.75 - 0.75 * row;
        b.add("step", box({2 * STAGE.half_x, height, 0.8}, 0.02), room.stone, dvec3(STAGE.x, height / 2, z));
        for (int column = 0; column < 7; ++column) {
            const float roughness = std::max(0.06f, static_cast<float>(column) / 6);
            const int material = b.material(fmt::format("{} {:.2f}", names[row], roughness),
                                            {colors[row], 0.5f * static_cast<float>(row), roughness});
            b.add("ball", sphere(0.26, 48, 24), material,
                  dvec3(STAGE.x + 0.7 * (column - 3), height + 0.26, z));
        }
    }
}

Primitive pedestal(double radius, double height) {
    return lathe({{0, 0},
                  {radius, 0},
                  {radius, 0.1},
                  {radius * 0.86, 0.16},
                  {radius * 0.78, 0.2},
                  {radius * 0.76, height - 0.16},
                  {radius * 0.82, height - 0.1},
                  {radius * 0.94, height - 0.07},
                  {radius * 0.94, height},
                  {0, height}},
                 48);
}

void sculptures(Room& room) {
    Builder& b = room.b;
    // The end of the hall: a knot before a ring of light.
    b.add("tall pedestal", pedestal(0.6, 1.1), room.stone, dvec3(KNOT.x, 0, KNOT.z));
    const int copper = b.material("brushed copper", {{0.95f, 0.56f, 0.4f}, 1, 1});
    b.scene.materials.back().metallic_roughness_texture = b.texture(brushed("brushed", 256), 3);
    b.add("knot", torusKnot(2, 3, 0.46, 0.22, 0.12), copper,
          at(KNOT.x, 1.92, KNOT.z) * turned(90, {1, 0, 0}));
    b.add("ring of light", torus(1.45, 0.06, 96, 16), room.glowing("cyan neon", CYAN * 5.0f),
          at(KNOT.x, 2.05, FAR_END + 0.35) * turned(90, {1, 0, 0}));

    // In front on the right: a stone of index 2.4 whose specular colour is not white.
    b.add("pedestal", pedestal(0.36, 0.92), room.stone, dvec3(GEM.x, 0, GEM.z));
    b.material("cut stone", {{0.05f, 0.015f, 0.09f}, 0, 0.09f});
    Material& cut = b.scene.materials.back();
    cut.ior = 2.4f;
    cut.specular_color = {1.0f, 0.8f, 1.0f};
    b.add("cut stone", gem(0.56), static_cast<int>(b.scene.materials.size() - 1),
          at(GEM.x, 0.9, GEM.z) * turned(11));

    // Vertex colours: a glaze that runs down. Little specular: an unglazed body.
    b.material("glaze", {vec3(1), 0, 0.25f});
    b.scene.materials.back().specular = 0.6f;
    const Primitive vase = lathe({{0, 0},
                                  {0.16, 0},
                                  {0.2, 0.06},
                                  {0.3, 0.26},
                                  {0.33, 0.42},
                                  {0.29, 0.58},
                                  {0.17, 0.74},
                                  {0.1, 0.86},
                                  {0.1, 0.96},
                                  {0.15, 1.04},
                                  {0.13, 1.04},
                                  {0.08, 0.95},
                                  {0.08, 0.86}},
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
          static_cast<int>(b.scene.materials.size() - 1), dvec3(VASE.x, 0.75, VASE.z));
    b.add("low pedestal", pedestal(0.42, 0.75), room.stone, dvec3(VASE.x, 0, VASE.z));
}

void greenery(Room& room) {
    Builder& b = room.b;
    const int pot = b.material("terracotta", {{0.42f, 0.17f, 0.09f}, 0, 0.8f});
    b.scene.materials.back().normal_texture = b.texture(normalMap("weave", weaveHeights(256), 14), 1);
    b.scene.materials.back().normal_texture.u.x = 6;
    b.add(
        "planter",
        lathe(
            {{0, 0}, {0.3, 0}, {0.4, 0.62}, {0.42, 0.62}, {0.42, 0.7}, {0.36, 0.7}, {0.34, 0.58}, {0, 0.58}},
            48),
        pot, dvec3(PLANTER.x, 0, PLANTER.z));
    b.material("leaf", {vec3(1), 0, 0.42f});
    const TextureSlot color =
        b.texture(leaf("leaf", 256), 1, {.wrap_s = Wrap::clamp_to_edge, .wrap_t = Wrap::clamp_to_edge});
    Material& green = b.scene.materials.back();
    green.base_color_texture = color;
    green.alpha_mode = AlphaMode::mask;
    green.double_sided = true;
    Primitive leaves;
    for (int i = 0; i < 46; ++i) {  // by the golden angle, the inner ones steeper and longer
        const double t = i / 45.0, size = 0.62 + 0.5 * (1 - t);
        const Primitive blade = quad({-0.28 * size, 0, 0}, {0.56 * size, 0, 0}, {0, size, 0}, 1, 6);
        Primitive bent = blade;
        for (std::size_t k = 0; k < bent.positions.size();
             ++k) {  // a circular arc, its radius one and a half leaves
            const float angle = blade.positions[k].y / (1.5f * static_cast<float>(size));
            const float radius = 1.5f * static_cast<float>(size);
            bent.positions[k].y = radius * std::sin(angle);
            bent.positions[k].z = -radius * (1 - std::cos(angle));
            bent.normals[k] = {0, std::sin(angle), std::cos(angle)};
        }
        append(leaves, bent,
               turned(137.50776 * i) * at(0, 0.06 * (1 - t), 0.02 + 0.16 * t) *
                   turned(8 + 62 * t, {1, 0, 0}) * turned(180));
    }
    b.add("leaves", leaves, static_cast<int>(b.scene.materials.size() - 1),
          dvec3(PLANTER.x, 0.58, PLANTER.z));

    b.material("brass lattice", {vec3(1), 1, 0.35f});
    const TextureSlot bars = b.texture(lattice("lattice", 256));
    Material& screen = b.scene.materials.back();
    screen.base_color_texture = bars;
    screen.alpha_mode = AlphaMode::mask;
    screen.double_sided = true;
    const int lattices = static_cast<int>(b.scene.materials.size() - 1);
    for (int i = 0; i < 3; ++i) {  // a folding screen
        const double x = 2.5 + 0.62 * i, turn = i % 2 == 0 ? 28 : -28;
        b.add("screen", scaleTexcoords(quad({-0.35, 0, 0}, {0.7, 0, 0}, {0, 1.9, 0}), 1.05, 2.85), lattices,
              at(x, 0.06, -4.4) * turned(turn));
        b.add("screen's frame", box({0.04, 2.0, 0.04}, 0.008), room.brass,
              at(x, 1.0, -4.4) * turned(turn) * at(-0.35, 0, 0));
    }
}

void glow(Room& room) {
    Builder& b = room.b;
    const Primitive rod =
        lathe({{0, 0}, {0.02, 0.005}, {0.035, 0.03}, {0.035, 2.17}, {0.02, 2.195}, {0, 2.2}}, 16);
    const int rose = room.glowing("rose neon", ROSE * 4.0f);
    for (int i = 0; i < 4; ++i) b.add("rod", rod, rose, dvec3(LEFT + 0.32, 0.9, NEAR_END - 1.6 - 4.0 * i));
    const int panel = room.glowing("ceiling panel", IVORY * 2.2f);
    for (int i = 0; i < 7; ++i)
        b.add("panel", quad({-0.8, 0, -0.3}, {1.6, 0, 0}, {0, 0, 0.6}), panel,
              dvec3(KNOT.x, CEILING - 0.05, NEAR_END - 2.6 - 2.0 * i));
    b.material("sign", {vec3(0.015f), 0, 0.25f, vec3(1.6f)});
    b.scene.materials.back().emissive_texture = b.texture(glyphs("sign", 256));
    const int sign = static_cast<int>(b.scene.materials.size() - 1);
    b.add("sign", scaleTexcoords(quad({0, 0, 0}, {1.5, 0, 0}, {0, 0.75, 0}), 1, 0.5), sign,
          at(LEFT + 0.08, 1.7, -0.85) * turned(90));
    const int strip = room.glowing("cyan strip", CYAN * 1.5f);
    b.add("strip", box({0.03, 0.03, 2 * STAGE.half_x}, 0.0), strip,
          at(STAGE.x, 0.03, STAGE.z + 1.17) * turned(90));
}

void lamps(Room& room) {
    Builder& b = room.b;
    for (int i = 0; i < 8; ++i) {  // washing the brick wall, and the arcade
        const double z = NEAR_END - 2.6 - 2.0 * i;
        b.spot({LEFT + 0.75, CEILING - 0.4, z}, {LEFT, 1.5, z}, WARM, 16, 6, 10, 34);
        if (i % 2 == 0)
            b.spot({RIGHT - 0.9, CEILING - 0.4, z - 0.6}, {RIGHT, 1.6, z - 0.6}, COOL, 14, 6, 12, 36);
    }
    for (int i = 0; i < 4; ++i)  // on the stage: from the front warm, from behind cool
        b.spot({STAGE.x - 2.4 + 1.6 * i, CEILING - 0.5, 0.4}, {STAGE.x - 1.8 + 1.2 * i, 1, STAGE.z}, IVORY,
               26, 8, 12, 24);
    for (int i = 0; i < 3; ++i)
        b.spot({STAGE.x - 2.2 + 2.2 * i, CEILING - 0.5, -6}, {STAGE.x - 1.8 + 1.8 * i, 1, STAGE.z}, COOL, 22,
               8, 14, 28);
    b.spot({KNOT.x - 1.5, CEILING - 0.5, KNOT.z + 2.2}, {KNOT.x, 1.9, KNOT.z}, WARM, 26, 7, 8, 16);
    b.spot({KNOT.x + 1.6, CEILING - 0.5, KNOT.z + 1.8}, {KNOT.x, 1.9, KNOT.z}, ROSE, 16, 7, 8, 16);
    b.spot({GEM.x - 1.1, CEILING - 0.6, GEM.z + 1.2}, {GEM.x, 1.1, GEM.z}, IVORY, 24, 6, 6, 13);
    b.spot({GEM.x + 1.2, 2.6, GEM.z - 1.4}, {GEM.x, 1.1, GEM.z}, CYAN, 8, 4, 10, 20);
    b.spot({VASE.x - 0.8, CEILING - 0.5, VASE.z + 1.4}, {VASE.x, 1.2, VASE.z}, WARM, 24, 6, 8, 16);
    b.spot({PLANTER.x + 0.9, CEILING - 0.5, PLANTER.z + 1.0}, {PLANTER.x, 1.1, PLANTER.z}, IVORY, 22, 6, 10,
           20);
    for (int i = 0; i < 8; ++i) {  // what the neon gives off
        const double angle = glm::radians(45.0 * i);
        b.point({KNOT.x + 1.45 * std::cos(angle), 2.05 + 1.45 * std::sin(angle), FAR_END + 0.55}, CYAN, 1.1f,
                4);
    }
    for (int i = 0; i < 4; ++i)
        for (double y : {1.4, 2.6}) b.point({LEFT + 0.5, y, NEAR_END - 1.6 - 4.0 * i}, ROSE, 0.9f, 3);
    for (int i = 0; i < 5; ++i) b.point({STAGE.x - 2 + i, 0.12, STAGE.z + 1.4}, CYAN, 0.12f, 1.2f);
    for (int i = 0; i < 7; ++i)
        b.spot({KNOT.x, CEILING - 0.1, NEAR_END - 2.6 - 2.0 * i}, {KNOT.x, 0, NEAR_END - 2.6 - 2.0 * i},
               IVORY, 5, 6.5f, 30, 75);
    for (int i = 0; i < 5; ++i)
        b.point({RIGHT - 0.35, 0.35, NEAR_END - 3.2 * i}, WARM, 0.9f, 2.6f);  // at the piers' feet
    b.sun({-0.75, -0.5, -0.35}, {0.5f, 0.66f, 1.0f}, 0.12f);                  // the moon, through the arches
}

}  // namespace

Scene gallery() {
    Room room;
    Builder& b = room.b;
    b.scene.background = {0.01f, 0.016f, 0.035f};
    b.camera("entrance", {-0.9, 1.62, 5.0}, {0.35, 1.35, -3}, 46, 0.1, 60);
    b.camera("stage", {1.6, 1.5, -0.2}, {0, 1.0, -3}, 50, 0.05, 60);
    room.stone = b.material("pale stone", {{0.5f, 0.48f, 0.46f}, 0, 0.55f});
    room.brass = b.material("brass", {{0.85f, 0.62f, 0.3f}, 1, 0.3f});
    room.dark_wood = b.material("dark wood", {{0.07f, 0.045f, 0.03f}, 0, 0.5f});
    walls(room);
    stage(room);
    sculptures(room);
    greenery(room);
    glow(room);
    lamps(room);
    return std::move(b.scene);
}

}  // namespace diptych::builtin
