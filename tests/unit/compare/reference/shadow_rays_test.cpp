// SPDX-License-Identifier: MIT
// Start and end of the reference's shadow rays: screens a millimetre from the surface or from the light,
// on either side, seen from near and far.
#include "tests/support/reference_scene.h"

namespace diptych::reference {
namespace {

// A wall z = 0 that faces +Z, seen straight on at the origin in an image of one pixel. Light arrives at 80
// degrees from the normal, so screens between light and wall are not in the camera's view.
const glm::dvec3 toLight{std::sin(glm::radians(80.0)), 0, std::cos(glm::radians(80.0))};

Scene wallScene(const Light& light) {
    Scene scene = floorScene();
    scene.lights = {light};
    return scene;
}
Light lampAt(double distance) {
    Light light = lightOf(LightKind::point, toLight * distance, -toLight);
    light.intensity = static_cast<float>(distance * distance);  // E = cos 80
    return light;
}

// A square with this half width, perpendicular to the light, `from` metres from the surface.
void addScreen(Scene& scene, double from, double half) {
    const glm::dvec3 y(0, 1, 0), x = glm::cross(y, toLight), corner = toLight * from - (x + y) * half;
    add(scene, quad(glm::vec3(corner), glm::vec3(x * (2 * half)), glm::vec3(y * (2 * half))));
}

enum class From { scene, capture, rounded_capture };

// The pixel's radiance relative to full light, cos 80 / pi.
double litFraction(const Scene& scene, double camera, From from) {
    const View view = viewFrom({0, 0, camera}, {0, 0, 0}, 1, 1);
    Drawn first = drawn(scene, view, true);
    const double whole = toLight.z / pi;
    if (from == From::scene) return double{first[Channel::lit].at(0, 0, 0)} / whole;
    // Shades a path's capture. With the scene's depth, the ray's start is found again exactly.
    if (from == From::rounded_capture) first.image.channels.at(Channel::depth).data[0] *= 1.001f;
    const ReferenceImage shaded = draw({.scene = scene,
                                        .pose = first.pose,
                                        .view = view,
                                        .lights = first.pose.lights,
                                        .casters = everyLight(first.pose.lights),
                                        .shadowed_environment = true,
                                        .mode = ReferenceMode::surface,
                                        .surfaces = &first.image.channels,
                                        .keep = {},
                                        .progress = {}});
    return double{shaded.channels.at(Channel::lit).at(0, 0, 0)} / whole;
}

constexpr double cameras[] = {1, 10, 100};

TEST(ReferenceShadowRays, InTheOpenTheWallIsFullyLit) {
    for (const double camera : cameras)
        for (const double distance : {0.05, 1.0, 30.0})
            for (const From from : {From::scene, From::capture, From::rounded_capture})
                EXPECT_NEAR(litFraction(wallScene(lampAt(distance)), camera, from), 1, 2e-6)
                    << camera << " " << distance;
}

// Smallest distance at which a screen must cast a shadow: a tenth of a millimetre above the wall, 0.58 mm
// along the ray. A capture with more error than its depth's rounding starts 1e-5 of the camera's distance
// away; this test requires ten times that.
TEST(ReferenceShadowRays, BeginAtTheSurface) {
    for (const double camera : cameras)
        for (const double distance : {0.5, 1.0, 30.0})
            for (const From from : {From::scene, From::capture, From::rounded_capture})
                for (const double along : {0.58e-3, 2e-3, 6e-3, 0.02, 0.25}) {
                    if (from == From::rounded_capture && along < 1e-4 * camera) continue;
                    Scene scene = wallScene(lampAt(distance));
                    addScreen(scene, along, 0.3 * along);
                    EXPECT_EQ(litFraction(scene, camera, from), 0)
                        << along << " m from the surface, camera " << camera << ", light " << distance;
                }
}

// Geometry behind the surface does not occlude, from a tenth of a millimetre to two centimetres below it.
TEST(ReferenceShadowRays, DoNotBeginBehindTheSurface) {
    for (const double camera : cameras)
        for (const From from : {From::scene, From::capture})
            for (const double behind : {1e-4, 1e-3, 6e-3, 0.02}) {
                Scene scene = wallScene(lampAt(1));
                add(scene, quad({-10, -10, static_cast<float>(-behind)}, {20, 0, 0}, {0, 20, 0}));
                addScreen(scene, -behind, 0.3 * behind);
                EXPECT_NEAR(litFraction(scene, camera, from), 1, 2e-6)
                    << behind << " m behind, camera " << camera;
            }
}

// A screen before the light hides it, one behind it does not. Gaps of 0.5, 2, 6 and 20 mm exceed the ray's
// own 1e-5 of its length, for a light at 5 cm to 30 m.
TEST(ReferenceShadowRays, EndAtTheLight) {
    for (const double camera : cameras)
        for (const double distance : {0.05, 1.0, 30.0})
            for (const From from : {From::scene, From::capture, From::rounded_capture})
                for (const double gap : {0.5e-3, 2e-3, 6e-3, 0.02}) {
                    Scene before = wallScene(lampAt(distance)), behind = before;
                    addScreen(before, distance - gap, 0.2 * distance);
                    addScreen(behind, distance + gap, 0.2 * distance);
                    EXPECT_EQ(litFraction(before, camera, from), 0)
                        << gap << " m before a light at " << distance;
                    EXPECT_NEAR(litFraction(behind, camera, from), 1, 2e-6)
                        << gap << " m behind a light at " << distance;
                }
}

// A ceiling does not hide a light that lies on it, but hides a light a millimetre above it.
TEST(ReferenceShadowRays, ALampOnACeilingShines) {
    for (const double gap : {0.0, 1e-3}) {
        Scene scene = wallScene(lampAt(3));
        addScreen(scene, 3 - gap, 1);
        EXPECT_NEAR(litFraction(scene, 5, From::scene), gap == 0 ? 1 : 0, 2e-6) << gap;
    }
}

// A screen at any distance hides all of the sun. A screen that covers an area light hides it from a
// millimetre before it.
TEST(ReferenceShadowRays, OfTheSunAndOfAreasReachTheirLights) {
    Light sun = lightOf(LightKind::directional, {0, 0, 0}, -toLight);
    sun.intensity = 1;
    for (const double along : {1e-3, 0.02, 1.0, 1000.0}) {
        Scene scene = wallScene(sun);
        EXPECT_NEAR(litFraction(scene, 10, From::scene), 1, 2e-6);
        addScreen(scene, along, 0.3 * along);
        EXPECT_EQ(litFraction(scene, 10, From::scene), 0) << along;
    }
    Light area = lightOf(LightKind::rect, toLight * 2.0, -toLight);
    area.width = area.height = 0.1f;
    for (const double gap : {1e-3, 6e-3, 0.02}) {
        Scene open = wallScene(area), before = open, behind = open;
        addScreen(before, 2 - gap, 0.5);
        addScreen(behind, 2 + gap, 0.5);
        const double whole = litFraction(open, 10, From::scene);
        EXPECT_GT(whole, 1e-3);
        EXPECT_EQ(litFraction(before, 10, From::scene), 0) << gap;
        EXPECT_NEAR(litFraction(behind, 10, From::scene), whole, 1e-6 * whole) << gap;
    }
}

}  // namespace
}  // namespace diptych::reference
