// SPDX-License-Identifier: MIT
// Test scenes about positions, visibility and transforms.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>

#include <cmath>

namespace diptych::builtin {
namespace {

int relief(Builder& b, const std::string& name, const glm::vec3& color, double tiles) {
    const int made = b.material(name, {color, 0, 0.35f});
    b.last().normal_texture = b.texture(normalMap(name, brickHeights(256), 8), tiles);
    return made;
}

}  // namespace

// All passes must resolve equal depths alike: in all of them the first draw wins, or in all the last.
void coplanar(Builder& b) {
    b.camera("above", {1.5, 2.6, 5}, {0, 0.3, 0}, 36, 0.1, 100);
    const glm::vec3 colors[] = {
        {0.8f, 0.2f, 0.1f}, {0.1f, 0.6f, 0.2f}, {0.1f, 0.2f, 0.8f}, {0.7f, 0.6f, 0.1f}};
    int materials[4];
    for (int i = 0; i < 4; ++i) materials[i] = b.material(fmt::format("colour {}", i), {colors[i], 0, 0.4f});
    // First the same square four times. Then coplanar squares with different corners: their interpolated
    // depths agree only in most pixels. Then the same triangles twice in one mesh.
    const Primitive square = quad({-2.5, 0, 2}, {2, 0, 0}, {0, 0, -2});
    for (int material : materials) b.add("equal squares", square, material);
    for (int i = 0; i < 4; ++i)
        b.add("overlapping squares",
              quad({0.1 + 0.3 * i, 0, 1.9 - 0.25 * i}, {1.3, 0, 0}, {0, 0, -1.3}, 1 + i, 2 + i),
              materials[i]);
    Primitive twice = quad({-2.5, 0, -0.3}, {2, 0, 0}, {0, 0, -1.5});
    const Primitive once = twice;
    append(twice, once);
    b.add("double triangles", twice, materials[3]);
    // Intersecting bodies, whose depths are equal along the seam.
    b.add("ball", sphere(0.6, 64, 32), materials[0], glm::dvec3(1, 0.4, -1));
    b.add("box", box({0.9, 0.9, 0.9}), materials[2], at(1.4, 0.35, -0.8) * rotated(30, {1, 2, 0}));
    b.add("ring", torus(0.7, 0.15), materials[1], at(1, 0.5, -1) * rotated(60, {1, 0, 1}));
    b.add("same ball, other mesh", sphere(0.6, 24, 12), materials[3], glm::dvec3(1, 0.4, -1));
    b.sun({-0.4, -1, -0.5}, glm::vec3(1), 2);
    b.point({-1, 1.5, 1}, {1.0f, 0.8f, 0.6f}, 4, 6);
}

// Objects from 0.2 m to 90 km in the corner of a wide view; the far plane is at 1e5 m.
void deep(Builder& b) {
    const glm::dvec3 eye(0, 1.7, 0);
    b.camera("corner", eye, eye + glm::dvec3(0.55, -0.15, -1), 75, 0.01, 1e5);
    b.scene.background = {0.2f, 0.3f, 0.5f};
    b.add("plain", quad({-1e5, 0, 1e5}, {2e5, 0, 0}, {0, 0, -2e5}),
          b.material("plain", {{0.3f, 0.28f, 0.22f}, 0, 0.7f}));
    // Distances and sizes grow alike by about ten times, so that all appear equally large.
    const double distances[] = {0.2, 1, 10, 100, 1000, 1e4, 9e4};
    for (int i = 0; i < 7; ++i) {
        const double d = distances[i], angle = -0.3 + 0.22 * i;
        const int material = b.material(
            fmt::format("{:g} m away", d),
            {{0.7f, 0.25f + 0.1f * static_cast<float>(i % 3), 0.2f}, static_cast<float>(i % 2), 0.25f});
        b.add(fmt::format("ball {:g} m away", d), sphere(0.1 * d, 64, 32), material,
              eye + glm::dvec3(std::sin(angle), 0.06, -std::cos(angle)) * d);
        b.point(eye + glm::dvec3(std::sin(angle - 0.1), 0.25, -std::cos(angle - 0.1)) * (0.85 * d),
                {1.0f, 0.9f, 0.7f}, static_cast<float>(0.12 * d * d), static_cast<float>(d));
    }
    b.sun({-0.3, -0.7, -0.5}, {1.0f, 0.95f, 0.85f}, 2);
}

// Each pair shows the same relief, mirrored by a node on the right. The bricks must protrude in both.
void mirrored(Builder& b) {
    b.camera("front", {0.05, 0, 7}, {0.05, 0, 0}, 36, 0.1, 100);
    const int bricks = relief(b, "bricks", {0.6f, 0.3f, 0.2f}, 1);
    const int wall = b.addMesh(quad({-0.9, -0.9, 0}, {1.8, 0, 0}, {0, 1.8, 0}), bricks, "wall");
    const int ball = b.addMesh(scaleTexcoords(sphere(0.8), 2, 1), bricks, "ball");
    b.addNode("wall", wall, at(-2.8, 1, 0));
    b.addNode("wall, x mirrored", wall, at(-0.9, 1, 0) * scaled(-1, 1, 1));
    b.addNode("wall, y mirrored", wall, at(1.0, 1, 0) * scaled(1, -1, 1));
    b.addNode("wall, x and y mirrored", wall, at(2.9, 1, 0) * scaled(-1, -1, 1));
    b.addNode("ball", ball, at(-2.8, -1, 0));
    b.addNode("ball, z mirrored", ball, at(-0.9, -1, 0) * scaled(1, 1, -1));
    const int mirror = b.addNode("mirror", -1, at(1.0, -1, 0) * scaled(-1, 1, 1));
    b.addNode("ball, mirrored by its parent", ball, glm::dmat4(1.0), mirror);
    b.addNode("ball, mirrored twice", ball, at(-1.9, 0, 0) * scaled(1, -1, 1), mirror);
    b.sun({0.8, -0.5, -0.6}, glm::vec3(1), 2);
    b.point({-2, 2.5, 2}, {0.6f, 0.8f, 1.0f}, 12, 12);
}

void stretched(Builder& b) {
    b.camera("front", {0, 1.2, 8}, {0, 0, 0}, 34, 0.1, 100);
    const int bricks = relief(b, "bricks", {0.55f, 0.5f, 0.45f}, 2);
    const int enamel = b.material("enamel", {{0.7f, 0.45f, 0.2f}, 0.2f, 0.25f});
    const int stone = b.addMesh(sphere(0.5, 64, 32), bricks, "stone ball");
    const int ball = b.addMesh(sphere(0.5, 64, 32), enamel, "enamel ball");
    const int cube = b.addMesh(box({0.8, 0.8, 0.8}, 0.05), enamel, "box");
    b.addNode("flat", ball, at(-3, 0.6, 0) * scaled(1.6, 0.3, 1));
    b.addNode("thin", ball, at(-1.3, 0.6, 0) * rotated(35, {0, 0, 1}) * scaled(0.15, 1.8, 0.6));
    b.addNode("flat stone", stone, at(-3, -0.8, 0) * scaled(1.5, 0.6, 1.5));
    b.addNode("tiny unit", stone, at(-1.2, -0.8, 0) * scaled(1e-4, 1e-4, 1e-4) * scaled(1.2e4, 0.8e4, 1e4));
    // Rotation under non-uniform scale is a shear: normals need the inverse transpose.
    const int squeeze = b.addNode("squeeze", -1, at(1.1, 0, 0) * scaled(1.6, 0.5, 1));
    b.addNode("sheared box", cube, at(0.1, 1.2, 0) * rotated(40, {0.3, 1, 1}), squeeze);
    const int deeper = b.addNode("turn", -1, at(0.2, -1.4, 0) * rotated(30, {0, 0, 1}), squeeze);
    b.addNode("sheared ball", ball, scaled(0.6, 2.2, 1), deeper);
    b.addNode("sheared stone", stone, at(1.1, 0, 0) * rotated(50, {1, 1, 0}) * scaled(1, 2, 0.4), deeper);
    b.sun({-0.5, -0.8, -0.6}, glm::vec3(1), 2);
    b.point({2, 2, 3}, {1.0f, 0.8f, 0.6f}, 14, 12);
}

// Near 1e6 m, float32 has steps of 62 mm: surfaces stay smooth only with camera-relative positions.
void farAway(Builder& b) {
    const glm::dvec3 here(1e6, 2e5, -1e6);
    b.camera("there", here + glm::dvec3(0, 1.5, 4), here + glm::dvec3(0, 0.5, 0), 40, 0.05, 1000);
    const int tiles = relief(b, "tiles", {0.5f, 0.5f, 0.55f}, 2);
    b.add("floor", quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 8, 8), tiles, here);
    for (int i = 0; i < 5; ++i) {
        const float r = static_cast<float>(i);
        b.add(
            "ball", sphere(0.35, 64, 32),
            b.material("ball", {{0.7f, 0.3f + 0.1f * r, 0.2f}, static_cast<float>(i % 2), 0.08f + 0.1f * r}),
            here + glm::dvec3(0.9 * (i - 2), 0.35, 0.1 * i));
    }
    b.point(here + glm::dvec3(-1, 1.6, 1), {1.0f, 0.8f, 0.6f}, 5, 6);
    b.spot(here + glm::dvec3(2, 2.5, 1), here + glm::dvec3(0.5, 0, 0), {0.6f, 0.8f, 1.0f}, 20, 8, {10, 25});
    b.sun({-0.3, -1, -0.4}, glm::vec3(1), 0.5f);
}

void ortho(Builder& b) {
    Camera& camera = b.camera("isometric", {6, 5, 6}, {0, 0.2, 0}, 60, 0.5, 20);
    camera.orthographic = true;
    camera.ymag = 2;
    const int stone = relief(b, "stone", {0.6f, 0.55f, 0.5f}, 1);
    b.add("floor", quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 4, 4), stone);
    for (int i = 0; i < 9; ++i) {
        const glm::dvec3 position(1.3 * (i % 3 - 1), 0.4, 1.3 * (i / 3 - 1));
        const int material =
            b.material(fmt::format("item {}", i), {{0.3f + 0.06f * static_cast<float>(i), 0.4f, 0.7f},
                                                   i % 3 == 1 ? 0.0f : static_cast<float>(i % 2),
                                                   0.1f + 0.1f * static_cast<float>(i)});
        if (i % 3 == 1)
            b.add("box", box({0.8, 0.8, 0.8}, 0.06), material, position);
        else
            b.add("ball", sphere(0.4), material, position);
    }
    b.sun({-0.3, -1, -0.6}, {1.0f, 0.95f, 0.9f}, 2);
    b.point({1, 1.5, 1.5}, {1.0f, 0.6f, 0.3f}, 4, 4);
}

void triangle(Builder& b) {
    b.camera("front", {0, 0, 3}, {0, 0, 0}, 40, 0.1, 10);
    Primitive one;
    one.positions = {{-1, -0.6f, 0}, {1, -0.6f, 0}, {0, 0.9f, 0}};
    one.normals.assign(3, {0, 0, 1});
    one.tangents.assign(3, {1, 0, 0, 1});
    one.texcoords[0] = {{0, 1}, {1, 1}, {0.5f, 0}};
    one.indices = {0, 1, 2};
    b.add("triangle", one, b.material("white", {glm::vec3(0.8f), 0, 0.5f}));
    b.point({0.5, 0.5, 1.5}, {1.0f, 0.9f, 0.8f}, 4, 5);
}

void empty(Builder& b) {
    b.scene.background = {0.1f, 0.1f, 0.1f};
}

void background(Builder& b) {
    b.camera("away", {0, 0, 3}, {0, 0, 10}, 40, 0.1, 100);
    b.add("ball behind the camera", sphere(1), b.material("white", {glm::vec3(0.8f), 0, 0.5f}));
    b.sun({0, -1, 0}, glm::vec3(1), 1);
    b.scene.background = {0.2f, 0.4f, 0.6f};
}

}  // namespace diptych::builtin
