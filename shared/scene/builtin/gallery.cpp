// SPDX-License-Identifier: MIT
// The default scene: a sculpture gallery in the evening.
#include "shared/scene/builtin/gallery.h"

#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <glm/trigonometric.hpp>

#include <cmath>

namespace diptych::builtin {

int Room::glowing(const std::string& name, const vec3& radiance) {
    return b.material(name, {vec3(0.02f), 0, 0.5f, radiance});
}

namespace {

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
    const int sign = b.material("sign", {vec3(0.015f), 0, 0.25f, vec3(1.6f)});
    b.last().emissive_texture = b.texture(glyphs("sign", 256));
    b.add("sign", scaleTexcoords(quad({0, 0, 0}, {1.5, 0, 0}, {0, 0.75, 0}), 1, 0.5), sign,
          at(LEFT + 0.08, 1.75, -1.1) * rotated(90));
    const int strip = room.glowing("cyan strip", CYAN * 1.5f);
    b.add("strip", box({0.03, 0.03, 2 * STAGE.half_x}, 0.0), strip,
          at(STAGE.x, 0.03, STAGE.z + 1.17) * rotated(90));
}

void lamps(Room& room) {
    Builder& b = room.b;
    for (int i = 0; i < 8; ++i) {  // down the brick wall, up to the beams, and above the arcade
        const double z = NEAR_END - 2.6 - 2.0 * i;
        b.spot({LEFT + 0.75, CEILING - 0.4, z}, {LEFT, 1.5, z}, WARM, 40, 6, {10, 36});
        if (i % 2 == 1) b.spot({LEFT + 0.5, 2.4, z}, {LEFT + 2.2, CEILING, z}, WARM, 9, 6, {20, 60});
        if (i % 2 == 0)
            b.spot({RIGHT - 0.9, CEILING - 0.4, z - 0.6}, {RIGHT, 1.6, z - 0.6}, COOL, 26, 6, {12, 38});
        if (i % 2 == 0)
            b.spot({RIGHT - 0.4, 2.6, z - 0.6}, {RIGHT - 2.2, CEILING, z - 0.6}, COOL, 7, 6, {20, 60});
    }
    for (int i = 0; i < 4; ++i)  // on the stage: warm from the front, cool from behind
        b.spot({STAGE.x - 2.7 + 1.8 * i, CEILING - 0.5, 0.6}, {STAGE.x - 1.8 + 1.2 * i, 0.9, STAGE.z}, IVORY,
               44, 9, {12, 26});
    for (int i = 0; i < 3; ++i)
        b.spot({STAGE.x - 2.6 + 2.6 * i, 3.2, -6}, {STAGE.x - 1.8 + 1.8 * i, 1, STAGE.z}, COOL, 40, 8,
               {14, 30});
    b.spot({KNOT.x - 1.5, CEILING - 0.5, KNOT.z + 2.2}, {KNOT.x, 2.38, KNOT.z}, WARM, 60, 7, {8, 16});
    b.spot({KNOT.x + 1.6, CEILING - 0.5, KNOT.z + 1.8}, {KNOT.x, 2.38, KNOT.z}, ROSE, 40, 7, {8, 16});
    b.spot({GEM.x - 1.1, CEILING - 0.6, GEM.z + 1.2}, {GEM.x, 1.1, GEM.z}, IVORY, 34, 6, {6, 13});
    b.spot({GEM.x + 1.2, 2.6, GEM.z - 1.4}, {GEM.x, 1.1, GEM.z}, CYAN, 16, 4, {10, 20});
    b.spot({VASE.x - 0.8, CEILING - 0.5, VASE.z + 1.4}, {VASE.x, 1.2, VASE.z}, WARM, 34, 6, {8, 16});
    b.spot({PLANTER.x + 0.9, CEILING - 0.5, PLANTER.z + 1.0}, {PLANTER.x, 1.1, PLANTER.z}, IVORY, 26, 6,
           {10, 20});
    b.spot({PLANTER.x + 1.2, 0.4, PLANTER.z + 2.2}, {PLANTER.x, 1.0, PLANTER.z}, IVORY, 6, 5, {10, 24});
    for (int i = 0; i < 8; ++i) {  // light emitted by the neon ring
        const double angle = glm::radians(45.0 * i);
        b.point({KNOT.x + 1.45 * std::cos(angle), 2.45 + 1.45 * std::sin(angle), FAR_END + 0.55}, CYAN, 1.8f,
                4);
    }
    for (int i = 0; i < 4; ++i)
        for (double y : {1.4, 2.6}) b.point({LEFT + 0.5, y, NEAR_END - 1.6 - 4.0 * i}, ROSE, 1.3f, 3);
    for (int i = 0; i < 5; ++i) b.point({STAGE.x - 2 + i, 0.12, STAGE.z + 1.4}, CYAN, 0.16f, 1.4f);
    for (int i = 0; i < 7; ++i)
        b.spot({KNOT.x, CEILING - 0.1, NEAR_END - 2.6 - 2.0 * i}, {KNOT.x, 0, NEAR_END - 2.6 - 2.0 * i},
               IVORY, 24, 6.5f, {30, 75});
    for (int i = 0; i < 5; ++i)
        b.point({RIGHT - 0.35, 0.35, NEAR_END - 3.2 * i}, WARM, 1.6f, 2.8f);  // at the piers' feet
    b.point({3.0, 0.6, -5.2}, WARM, 3.0f, 4);                                 // behind the screen
    b.sun({-0.75, -0.5, -0.35}, {0.62f, 0.66f, 1.0f}, 0.3f);  // evening sun through the arches
}

}  // namespace

void gallery(Builder& b) {
    Room room{b};
    b.scene.background = {0.01f, 0.016f, 0.035f};
    b.camera("entrance", {-0.55, 1.62, 5.5}, {0.12, 1.47, -3}, 46, 0.1, 60);
    b.camera("stage", {1.6, 1.5, -0.2}, {0, 1.0, -3}, 50, 0.05, 60);
    room.stone = b.material("pale stone", {{0.34f, 0.325f, 0.31f}, 0, 0.55f});
    room.brass = b.material("brass", {{0.85f, 0.62f, 0.3f}, 1, 0.3f});
    room.dark_wood = b.material("dark wood", {{0.07f, 0.045f, 0.03f}, 0, 0.5f});
    addWalls(room);
    addExhibits(room);
    glow(room);
    lamps(room);
}

}  // namespace diptych::builtin
