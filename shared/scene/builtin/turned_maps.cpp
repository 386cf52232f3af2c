// SPDX-License-Identifier: MIT
// The test scene of normal maps that are read turned, mirrored, or from the second UV set.
#include "shared/scene/builtin/builder.h"
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"
#include "shared/scene/model/tangents.h"

#include <glm/trigonometric.hpp>

#include <cmath>
#include <string>
#include <utility>

namespace diptych::builtin {
namespace {

struct Turn {
    const char* name;
    double degrees;       // by which the coordinates are turned
    double u = 1, v = 1;  // by which they are scaled before; negative: mirrored
    int texcoord = 0;
};
constexpr Turn turns[] = {{"plain", 0},
                          {"turned by 35 degrees", 35},
                          {"turned by 90 degrees", 90},
                          {"turned by 200 degrees", 200},
                          {"u mirrored", 0, -1, 1},
                          {"v mirrored and turned", 65, 1, -1},
                          {"second set", 20, 1, 1, 1}};

// The second UV set is the first, turned by a quarter.
Primitive withTurnedSet(Primitive shape) {
    for (const glm::vec2& uv : shape.texcoords[0]) shape.texcoords[1].push_back({uv.y, 1 - uv.x});
    return shape;
}

}  // namespace

// The same tiles on planes above and on columns below, read through a transform (KHR_texture_transform) that
// differs from left to right: turned by several angles, mirrored, and of the second UV set. Lit from the
// upper left, tiles stand out everywhere: tangents of untransformed coordinates would light some from the
// right or from below.
Scene tangents() {
    Builder b;
    b.camera("front", {0, 0, 11}, {0, 0, 0}, 24, 0.1, 100);
    const TextureSlot tiles = b.texture(normalMap("tiles", tileHeights(128), 5), 1);
    double x = -3.6;
    for (const Turn& turn : turns) {
        const int material = b.material(turn.name, {{0.6f, 0.35f, 0.25f}, 0, 0.4f});
        const double c = std::cos(glm::radians(turn.degrees)), s = std::sin(glm::radians(turn.degrees));
        TextureSlot slot = tiles;
        slot.texcoord = turn.texcoord;
        slot.u = {c * turn.u, s * turn.v, 0.25};
        slot.v = {-s * turn.u, c * turn.v, 0.125};
        b.scene.materials.back().normal_texture = slot;
        const auto add = [&](const std::string& shape, Primitive primitive, double y) {
            primitive = withTurnedSet(std::move(primitive));
            makeTangents(primitive, slot);
            primitive.tangents_made = true;
            b.add(shape + ", " + turn.name, std::move(primitive), material, {x, y, 0});
        };
        add("plane", quad({-0.5, -0.8, 0}, {1, 0, 0}, {0, 1.6, 0}, 2, 2), 0.95);
        add("column", lathe({{0.4, -0.8}, {0.4, 0}, {0.4, 0.8}}, 64), -0.95);
        x += 1.2;
    }
    b.sun({0.8, -0.7, -0.6}, glm::vec3(1), 2.5f);
    return std::move(b.scene);
}

}  // namespace diptych::builtin
