// SPDX-License-Identifier: MIT
// Light through closed meshes in mode scene: a glass ball and a glass plate, by independent formulas.
#include "compare/reference/scene/mesh_path.h"

#include "tests/support/reference_scene.h"

#include "shared/scene/builtin/shapes.h"

namespace diptych::reference {
namespace {

// Glass that reflects nothing on its outside: the model's layer has F = 0 there.
Material clearGlass() {
    Material m = matte();
    m.transmission = 1;
    m.roughness = 0;
    m.thickness = 1;
    return m;
}

// A ball of radius 1 at the origin, above a white floor at z = -3 that a point at (0, 0, -1.5) lights. The
// ball casts no shadow.
Scene ballScene(const Material& glass) {
    Scene scene = floorScene();
    for (glm::vec3& p : scene.meshes[0].primitives[0].positions) p.z = -3;
    scene.materials.push_back(glass);
    Primitive ball = sphere(1, 256, 128);
    ball.material = 1;
    add(scene, ball);
    scene.lights = {lightOf(LightKind::point, {0, 0, -1.5})};
    return scene;
}
double floorUnderBall(const glm::dvec3& position) {
    const glm::dvec3 path = glm::dvec3(0, 0, -1.5) - position;
    return path.z / std::pow(glm::length(path), 3) / pi;
}

// Looks down at x = `beside`.
View downAt(double beside) {
    return viewFrom({beside, 0, 10}, {beside, 0, 0}, 1, 1, 1e-4);
}

// The light that a ray along -Z at x = `beside` brings through a ball of radius 1: by the angles of a circle,
// the ray leaves after k reflections at the polar angle i + (k + 1) (pi - 2 r) from +Z, turned by
// 2 (i - r) + k (pi - 2 r). `absorbed`: fraction that remains after a metre.
double throughBall(double beside, double index, double absorbed) {
    const double i = std::asin(beside), r = std::asin(beside / index);
    const double across = std::pow(std::sin(i - r) / std::sin(i + r), 2),
                 along = std::pow(std::tan(i - r) / std::tan(i + r), 2), reflected = (across + along) / 2;
    double sum = 0;
    for (int k = 0; k < 16; ++k) {
        const double polar = i + (k + 1) * (pi - 2 * r), turn = 2 * (i - r) + k * (pi - 2 * r);
        const glm::dvec3 position(std::sin(polar), 0, std::cos(polar)),
            d(-std::sin(turn), 0, -std::cos(turn));
        const glm::dvec3 floor = position + d * ((-3 - position.z) / d.z);
        if (!(d.z < 0) || std::abs(floor.x) > 10) continue;
        sum += (1 - reflected) * std::pow(reflected, k) * std::pow(absorbed, 2 * (k + 1) * std::cos(r)) *
               floorUnderBall(floor);
    }
    return sum;
}

void expectThrough(const Drawn& d, const glm::dvec3& expected, double beside) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(double{d[Channel::lit].at(0, 0, c)}, expected[c],
                    2 * double{d.image.uncertainty.data.empty() ? 0.0f : d.image.uncertainty.at(0, 0)} +
                        5e-3 * expected[c])
            << beside << " " << c;
}

TEST(ReferenceMeshPath, ABallIsALens) {
    for (const double beside : {0.2, 0.5, 0.7})
        expectThrough(drawn(ballScene(clearGlass()), downAt(beside)), glm::dvec3(throughBall(beside, 1.5, 1)),
                      beside);
}

TEST(ReferenceMeshPath, ABallAbsorbsAlongItsChords) {
    Material m = clearGlass();
    m.attenuation_color = {0.5f, 1, 0.25f};
    m.attenuation_distance = 1;
    for (const double beside : {0.2, 0.6})
        expectThrough(
            drawn(ballScene(m), downAt(beside)),
            {throughBall(beside, 1.5, 0.5), throughBall(beside, 1.5, 1), throughBall(beside, 1.5, 0.25)},
            beside);
}

TEST(ReferenceMeshPath, ABallDispersesByComponent) {
    Material m = clearGlass();
    m.dispersion = 8;
    const Drawn d = drawn(ballScene(m), downAt(0.6));
    expectThrough(d, {throughBall(0.6, 1.4, 1), throughBall(0.6, 1.5, 1), throughBall(0.6, 1.6, 1)}, 0.6);
    EXPECT_GT(std::abs(throughBall(0.6, 1.4, 1) / throughBall(0.6, 1.6, 1) - 1), 0.05);
}

// Without a boundary the floor is seen in place, whatever the roughness.
TEST(ReferenceMeshPath, AnIndexOfOneIsInvisible) {
    Material m = clearGlass();
    m.ior = 1;
    for (const float roughness : {0.0f, 1.0f}) {
        m.roughness = roughness;
        for (const double beside : {0.1, 0.5}) {
            const double seen = double{drawn(ballScene(m), downAt(beside))[Channel::lit].at(0, 0)};
            EXPECT_NEAR(seen, floorUnderBall({beside, 0, -3}), 1e-5) << roughness << " " << beside;
        }
    }
}

// Under light 1 from everywhere clear glass keeps all light: what a boundary reflects inside leaves later.
TEST(ReferenceMeshPath, AWhiteFurnaceStaysWhite) {
    for (const float roughness : {0.0f, 0.5f}) {
        Material m = clearGlass();
        m.roughness = roughness;
        Scene scene = ballScene(m);
        scene.meshes[0].primitives.erase(scene.meshes[0].primitives.begin());
        scene.lights.clear();
        scene.environment = Environment{"furnace", Image(8, 4, 3, 1.0f)};
        for (const double beside : {0.1, 0.6, 0.9}) {
            const double lit = double{drawn(scene, downAt(beside))[Channel::lit].at(0, 0)};
            EXPECT_LE(lit, 1 + 1e-6) << roughness << " " << beside;
            EXPECT_GE(lit, 0.99) << roughness << " " << beside;
        }
    }
}

// A thickness of 0 is a thin wall: the ray goes straight on through front and back.
TEST(ReferenceMeshPath, AHollowBallIsAThinWall) {
    Material m = clearGlass();
    m.thickness = 0;
    const double seen = double{drawn(ballScene(m), downAt(0.5))[Channel::lit].at(0, 0)};
    EXPECT_NEAR(seen, floorUnderBall({0.5, 0, -3}), 1e-6);
}

// An opaque thing in the glass ends the path after the length to it.
TEST(ReferenceMeshPath, WhatIsInsideIsSeenThroughTheMedium) {
    Material m = clearGlass(), core = matte();
    m.attenuation_color = {0.5f, 1, 1};
    m.attenuation_distance = 1;
    core.emissive = {2, 2, 2};
    Scene scene = ballScene(m);
    scene.lights.clear();
    scene.materials.push_back(core);
    add(scene, quad({-0.5f, -0.5f, 0.25f}, {1, 0, 0}, {0, 1, 0}, 2));
    const Drawn d = drawn(scene, downAt(0));
    EXPECT_NEAR(double{d[Channel::lit].at(0, 0, 0)}, 2 * std::pow(0.5, 0.75), 1e-3);
    EXPECT_NEAR(double{d[Channel::lit].at(0, 0, 1)}, 2, 1e-5);
}

}  // namespace
}  // namespace diptych::reference
