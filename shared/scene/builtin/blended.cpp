// SPDX-License-Identifier: MIT
// Test scenes of alpha blending, with cases that draw order solves and cases that it cannot.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>

#include <utility>

namespace diptych::builtin {

namespace {

constexpr Surface floorSurface{{0.5f, 0.48f, 0.45f}, 0, 0.6f}, wallSurface{{0.7f, 0.7f, 0.65f}, 0, 0.8f};

int blended(Builder& b, const std::string& name, const Surface& surface, float opacity) {
    const int material = b.material(name, surface);
    b.last().alpha_mode = AlphaMode::blend;
    b.last().base_color.a = opacity;
    return material;
}

// `count` parallel panes, sorted from back to front.
void addPanes(Builder& b, int count, const glm::dvec3& corner, float opacity) {
    for (int i = 0; i < count; ++i) {
        const float hue = static_cast<float>(i % 4) / 3;
        const int material = blended(b, fmt::format("pane {}", i),
                                     {{0.9f - 0.7f * hue, 0.3f, 0.2f + 0.7f * hue}, 0, 0.3f}, opacity);
        b.add("pane", quad(corner + glm::dvec3(0, 0, 0.04 * i), {0.9, 0, 0}, {0, 0.9, 0}), material);
    }
}

}  // namespace

void glass(Builder& b) {
    b.camera("front", {0.2, 1.5, 6}, {0, 1.1, 0}, 44, 0.1, 100);
    // This camera is inside a ball and its near plane cuts the ball.
    b.camera("inside", {2.2, 0.62, 0.75}, {0, 0.8, -0.5}, 60, 0.05, 100);
    b.add("floor", quad({-4, 0, 3}, {8, 0, 0}, {0, 0, -5}, 8, 5), b.material("floor", floorSurface));
    // Everything that follows has its upper half against the sky.
    b.add("wall", quad({-3.2, 0, -1.2}, {6.4, 0, 0}, {0, 1.1, 0}), b.material("wall", wallSurface));

    addPanes(b, 32, {-3.1, 0.3, -1}, 0.1f);
    addPanes(b, 4, {-2.0, 0.3, -0.6}, 0.5f);
    // One-sided and two-sided balls and a metallic one; the second contains the camera "inside".
    const int green = blended(b, "green", {{0.2f, 0.7f, 0.3f}, 0, 0.1f}, 0.4f);
    b.add("one side", sphere(0.35, 48, 24), green, glm::dvec3(0.9, 0.36, 0.6));
    const int both = blended(b, "both sides", {{0.3f, 0.6f, 0.9f}, 0, 0.15f}, 0.3f);
    b.last().double_sided = true;
    b.add("both sides", sphere(0.4, 48, 24), both, glm::dvec3(2.2, 0.6, 0.6));
    b.add("metal", sphere(0.3, 48, 24), blended(b, "metal", {{0.9f, 0.7f, 0.3f}, 1, 0.3f}, 0.6f),
          glm::dvec3(1.55, 1.5, -0.4));
    // Opacity 0, 1, from a texture, and from vertex colours beyond 1; and a surface that no light reaches.
    const glm::dvec3 right(0.5, 0, 0), up(0, 0.5, 0);
    b.add("nothing", quad({-1.9, 1.5, 0.2}, right, up), blended(b, "nothing", {}, 0));
    b.add("all", quad({-1.3, 1.5, 0.2}, right, up), blended(b, "all", {{0.8f, 0.5f, 0.2f}, 0, 0.5f}, 1));
    const int holes = blended(b, "holes", {glm::vec3(1), 0, 0.5f}, 0.8f);
    b.last().base_color_texture = b.texture(lattice("lattice", 64), 1);
    b.add("holes", quad({-0.7, 1.5, 0.2}, right, up), holes);
    const int painted = blended(b, "painted", {glm::vec3(1), 0, 0.5f}, 1);
    const auto fading = [](const glm::vec3& p) {
        return glm::vec4(0.5f + p.x, 0.6f, 1.0f - p.x, 1.4f * (p.y - 1.5f) / 0.5f);
    };
    b.add("painted", paint(quad({-0.1, 1.5, 0.2}, right, up, 8, 8), fading), painted);
    const int sign = blended(b, "unlit", {{0.1f, 0.5f, 0.4f}, 0, 0.5f}, 0.7f);
    b.last().unlit = true;
    b.add("unlit", quad({0.5, 1.5, 0.2}, right, up), sign);
    b.add("emits", quad({-0.7, 0.9, 0.9}, right, up * 0.5),
          blended(b, "emits", {{0.1f, 0.1f, 0.1f}, 0, 0.5f, {0.6f, 0.3f, 0.9f}}, 0.5f));

    b.sun({-0.4, -1, -0.6}, {1.0f, 0.95f, 0.9f}, 2);
    b.point({-1.5, 1.8, 1.5}, {1.0f, 0.7f, 0.4f}, 3, 5);
    b.point({1.2, 1.2, -0.9}, {0.4f, 0.7f, 1.0f}, 2, 2);
    b.point({0, 0.5, 1.5}, {0.6f, 1.0f, 0.6f}, 1, 2);
}

void crossed(Builder& b) {
    b.camera("front", {0.2, 1.2, 4}, {0, 0.7, 0}, 40, 0.1, 100);
    b.add("floor", quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -3}), b.material("floor", floorSurface));
    b.add("wall", quad({-1.6, 0, -0.8}, {3.2, 0, 0}, {0, 1.1, 0}), b.material("wall", wallSurface));
    const int red = blended(b, "red", {{0.8f, 0.1f, 0.1f}, 0, 0.4f}, 0.5f);
    b.last().double_sided = true;
    const int blue = blended(b, "blue", {{0.1f, 0.2f, 0.8f}, 0, 0.4f}, 0.5f);
    b.last().double_sided = true;
    // Intersecting panes: no draw order is right.
    for (const auto& [material, degrees] : {std::pair(red, 40.0), {blue, -40.0}})
        b.add("crossed", quad({-0.5, 0, 0}, {1, 0, 0}, {0, 1, 0}), material,
              at(-0.7, 0.3, 0) * rotated(degrees));
    // Coplanar panes, with the same corners as each other, and on the wall.
    for (const int material : {red, blue})
        b.add("coplanar", quad({0.1, 0.6, -0.4}, {0.6, 0, 0}, {0, 0.8, 0}), material);
    for (const int material : {red, blue})
        b.add("on the wall", quad({0.9, 0.3, -0.8}, {0.5, 0, 0}, {0, 0.6, 0}), material);
    // A ring: its near and far sides are in one draw call.
    b.add("ring", torus(0.35, 0.12), red, at(0.6, 0.5, 0.7) * rotated(70, {1, 0, 0.3}));
    b.sun({-0.4, -1, -0.6}, {1.0f, 0.95f, 0.9f}, 2);
    b.point({-0.5, 1.4, 1.2}, {1.0f, 0.7f, 0.4f}, 2, 4);
}

}  // namespace diptych::builtin
