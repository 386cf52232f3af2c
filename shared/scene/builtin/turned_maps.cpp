// SPDX-License-Identifier: MIT
// The test scene of normal maps that are rotated, mirrored, or read by the second UV set.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"
#include "shared/scene/model/animated.h"
#include "shared/scene/model/tangents.h"

#include <glm/trigonometric.hpp>

#include <string>
#include <utility>

namespace diptych::builtin {
namespace {

struct Turn {
    const char* name;
    double degrees;       // rotation of the coordinates
    double u = 1, v = 1;  // scale before the rotation; negative: mirrored
    int texcoord = 0;
};
constexpr Turn turns[] = {{"plain", 0},
                          {"turned by 35 degrees", 35},
                          {"turned by 90 degrees", 90},
                          {"turned by 200 degrees", 200},
                          {"u mirrored", 0, -1, 1},
                          {"v mirrored and turned", 65, 1, -1},
                          {"second set", 20, 1, 1, 1}};

void turnOverTime(Scene& scene, int material, const TextureTransform& rest) {
    MaterialParts parts;
    parts.transforms[gpu::SLOT_normal] = rest;
    scene.material_parts[material] = parts;
    Animation& turning = scene.animations.back();
    const auto add = [&](AnimatedPart part, Keyframes frames) {
        turning.channels.push_back({.keyframes = static_cast<int>(turning.keyframes.size()),
                                    .part = part,
                                    .object = material,
                                    .element = gpu::SLOT_normal});
        turning.keyframes.push_back(std::move(frames));
    };
    const auto from = static_cast<float>(rest.rotation);
    const glm::vec2 scale(rest.scale);
    add(AnimatedPart::texture_rotation,
        {Interpolation::linear, {0, 4}, {from, from + glm::radians(120.0f)}, 1});
    add(AnimatedPart::texture_scale, {Interpolation::step, {0, 3}, {scale.x, scale.y, -scale.x, scale.y}, 2});
}

}  // namespace

// The same tiles on planes (top) and columns (bottom). KHR_texture_transform differs from left to right:
// rotated by several angles, mirrored, and on the second UV set. Light comes from the upper left, so tiles
// must protrude everywhere. Tangents of untransformed coordinates would light some from the right or
// below. The animation rotates all maps by 120 degrees in 4 s and mirrors them after 3 s. Tangents of the
// maps at rest would be as wrong.
void tangents(Builder& b) {
    b.scene.animations.push_back({"turning", {}, {}});
    b.camera("front", {0, 0, 11}, {0, 0, 0}, 24, 0.1, 100);
    const TextureSlot tiles = b.texture(normalMap("tiles", tileHeights(128), 5), 1);
    double x = -3.6;
    for (const Turn& turn : turns) {
        const int material = b.material(turn.name, {{0.6f, 0.35f, 0.25f}, 0, 0.4f});
        const TextureTransform transform{
            {0.25, 0.125}, {turn.u, turn.v}, glm::radians(static_cast<float>(turn.degrees))};
        TextureSlot slot = tiles;
        slot.texcoord = turn.texcoord;
        setTransform(slot, transform);
        b.last().normal_texture = slot;
        turnOverTime(b.scene, material, transform);
        const auto add = [&](const std::string& shape, Primitive primitive, double y) {
            primitive = withTurnedSet(std::move(primitive));
            makeTangents(primitive, slot, true);
            primitive.tangents_made = true;
            b.add(shape + ", " + turn.name, std::move(primitive), material, {x, y, 0});
        };
        add("plane", quad({-0.5, -0.8, 0}, {1, 0, 0}, {0, 1.6, 0}, 2, 2), 0.95);
        add("column", lathe({{0.4, -0.8}, {0.4, 0}, {0.4, 0.8}}, 64), -0.95);
        x += 1.2;
    }
    b.sun({0.8, -0.7, -0.6}, glm::vec3(1), 2.5f);
}

}  // namespace diptych::builtin
