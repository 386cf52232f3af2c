// SPDX-License-Identifier: MIT
// The reference's lights on a white plane, compared with closed forms.
#include "tests/support/reference_builder.h"

#include "compare/reference/light/punctual.h"

#include <glm/gtc/quaternion.hpp>

namespace diptych::reference {
namespace {

// The quadrature's tolerance is 2e-6 of the integral; the actual error is far smaller.
constexpr double exact = 1e-6;

void expectRelative(double value, double expected, double tolerance = exact) {
    EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

// ---- disc --------------------------------------------------------------------------------------------

TEST(ReferenceClosedForms, ADiscOverAPlaneOnItsAxis) {
    for (const float radius : {0.001f, 0.25f, 1.0f, 40.0f}) {
        Light disc = lightOf(LightKind::disc, {0, 0, 2});
        disc.radius = radius;
        disc.intensity = 3;
        const double r2 = double{radius} * double{radius};
        expectRelative(irradianceBy(disc, lambertian()), 3 * pi * r2 / (r2 + 4));
    }
}

// Howell, Menguec and Siegel 2010, "Thermal Radiation Heat Transfer", configuration factor of an element
// parallel to a disc.
TEST(ReferenceClosedForms, ADiscOverAPlaneOffItsAxis) {
    for (const double aside : {0.0, 0.3, 1.0, 1.5, 7.0})
        for (const double height : {0.05, 0.8, 3.0}) {
            Light disc = lightOf(LightKind::disc, {aside, 0, height});
            disc.radius = 1;
            const double sum = height * height + aside * aside;
            const double factor = (1 - (sum - 1) / std::sqrt((sum + 1) * (sum + 1) - 4 * aside * aside)) / 2;
            expectRelative(irradianceBy(disc, lambertian()), pi * factor);
        }
}

TEST(ReferenceClosedForms, ATiltedDiscPartlyBelowTheHorizon) {
    for (const glm::dvec3 normal :
         {glm::dvec3(0, 0, 1), {1, 0, 0}, {1, 0.3, 0.2}, {-0.5, -1, 0.7}, {1, 0, 0.001}}) {
        Light disc = lightOf(LightKind::disc, {0.4, 0.1, 1.2}, {0.3, -0.2, -1});
        disc.radius = 0.75f;
        std::vector<glm::dvec3> outline;
        addArc(outline, disc.position, disc.axis * 0.75, glm::cross(disc.direction, disc.axis) * 0.75, 0,
               2 * pi);
        const glm::dvec3 n = glm::normalize(normal);
        expectRelative(irradianceBy(disc, lambertian(n)), lambertIrradiance(outline, n));
    }
}

// ---- rectangle ---------------------------------------------------------------------------------------

TEST(ReferenceClosedForms, RectanglesByLambertsFormula) {
    for (const glm::dvec3 normal :
         {glm::dvec3(0, 0, 1), {1, 0, 0}, {0.7, -0.7, 0.1}, {-1, 2, 0.4}, {0.3, 1, -0.1}})
        for (const glm::dvec3 direction : {glm::dvec3(0, 0, -1), {0.5, 0.2, -1}, {0.3, -0.9, -0.4}})
            for (const double distance : {0.2, 1.0, 30.0}) {
                Light rect = lightOf(LightKind::rect, {0.1 * distance, 0.2 * distance, distance}, direction);
                rect.width = 1.5f;
                rect.height = 0.5f;
                const Surface s = lambertian(normal);
                const double expected = lambertIrradiance(cornersOf(rect), s.normal);
                EXPECT_NEAR(irradianceBy(rect, s), expected, exact * expected) << distance;
            }
}

// Most of the light arrives from a millionth of the area.
TEST(ReferenceClosedForms, ALargeLightNearby) {
    for (const double height : {1e-4, 1e-2}) {
        Light rect = lightOf(LightKind::rect, {31, 17, height});
        rect.width = rect.height = 100;
        expectRelative(irradianceBy(rect, lambertian()), lambertIrradiance(cornersOf(rect), {0, 0, 1}));
        rect.position = {31, height, 0};  // the lower half is below the horizon
        rect.direction = {0, -1, 0};
        rect.axis = {1, 0, 0};
        const glm::dvec3 n = glm::normalize(glm::dvec3(0, 0.01, 1));
        expectRelative(irradianceBy(rect, lambertian(n)), lambertIrradiance(cornersOf(rect), n));
    }
}

TEST(ReferenceClosedForms, AFlatLightShinesFromItsSideOrBoth) {
    for (const LightKind kind : {LightKind::rect, LightKind::disc}) {
        Light light = lightOf(kind, {0.2, 0, 1}, {0.1, 0, -1});
        const double front = irradianceBy(light, lambertian());
        EXPECT_GT(front, 0.1);
        light.direction = -light.direction;
        EXPECT_EQ(irradianceBy(light, lambertian()), 0) << "its back is dark";
        light.two_sided = true;
        expectRelative(irradianceBy(light, lambertian()), front);
        EXPECT_EQ(irradianceBy(light, lambertian({0, 0, -1})), 0) << "below the horizon";
    }
}

TEST(ReferenceClosedForms, LightsEndAtTheirRangeExactly) {
    for (const LightKind kind :
         {LightKind::point, LightKind::spot, LightKind::rect, LightKind::disc, LightKind::tube}) {
        Light light = lightOf(kind, {0, 0, 3});
        const double without = irradianceBy(light, lambertian());
        light.range = 4;
        expectRelative(irradianceBy(light, lambertian()), without * (1 - std::pow(0.75, 4)));
        light.range = 3;
        EXPECT_EQ(irradianceBy(light, lambertian()), 0);
        light.range = 2;
        EXPECT_EQ(irradianceBy(light, lambertian()), 0);
    }
    EXPECT_EQ(rangeWindow(1e9, std::numeric_limits<double>::infinity()), 1);
    EXPECT_EQ(rangeWindow(1e9, std::numeric_limits<double>::infinity(), RangeWindow::squared), 1);
    EXPECT_DOUBLE_EQ(rangeWindow(1, 2, RangeWindow::squared), 0.9375 * 0.9375);
    EXPECT_EQ(rangeWindow(2, 2, RangeWindow::squared), 0);
}

// ---- tube --------------------------------------------------------------------------------------------

// Outline of a cylinder seen from the origin: two lines along its side and half of each rim. It is the far
// half if the cap is visible, otherwise the near half.
std::vector<glm::dvec3> outlineOf(const Light& tube) {
    const glm::dvec3 axis = tube.axis, c = tube.position;
    const double radius = tube.radius, half_length = double{tube.length} / 2, along = -glm::dot(c, axis);
    const glm::dvec3 out = -c - axis * along;
    const double distance = glm::length(out);
    const glm::dvec3 x =
        distance > 0 ? out / distance : glm::normalize(glm::cross(axis, glm::dvec3(0.2, 0.3, 1)));
    const glm::dvec3 y = glm::cross(axis, x);
    std::vector<glm::dvec3> outline;
    const double cap = along > 0 ? half_length : -half_length;
    if (distance <= radius) {
        addArc(outline, c + axis * cap, x * radius, y * radius, 0, 2 * pi);
        return outline;
    }
    const double t = std::acos(radius / distance);
    const auto end = [&](double at, bool seen, bool back) {
        const double from = back ? -t : t, to = back ? (seen ? t - 2 * pi : t) : (seen ? 2 * pi - t : -t);
        addArc(outline, c + axis * at, x * radius, y * radius, from, to);
    };
    end(half_length, along > half_length, false);
    end(-half_length, along < -half_length, true);
    return outline;
}

TEST(ReferenceClosedForms, TubesByTheirOutline) {
    struct Case {
        glm::dvec3 position, axis, normal;
        float radius, length;
    };
    const std::vector<Case> cases{
        {{0, 0, 1}, {1, 0, 0}, {0, 0, 1}, 0.1f, 1},          // above
        {{0, 0, 1}, {1, 0, 0}, {0, 0, 1}, 0.9f, 3},          // thick and near
        {{3, 0, 1}, {1, 0, 0}, {0, 0, 1}, 0.3f, 2},          // beside its end, which is visible
        {{1.5, 0.1, 0}, {1, 0, 0}, {1, 0, 0.2}, 0.4f, 2},    // on its axis: only the cap is visible
        {{0, 0, 2}, {0.2, 0.1, 1}, {0, 0, 1}, 0.25f, 1},     // cap and side
        {{0.7, 0.4, 0.2}, {0, 0.3, 1}, {0, 0, 1}, 0.2f, 3},  // the axis crosses the horizon
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.3f, 1},          // the axis lies on the horizon
        {{0.6, -0.2, 0.5}, {1, 0, -1}, {0.3, 0, 1}, 0.1f, 4}, {{0, 0, 5}, {1, 0, 0}, {0, 0, 1}, 0.001f, 100}};
    for (const Case& c : cases) {
        Light tube = lightOf(LightKind::tube, c.position);
        tube.axis = glm::normalize(c.axis);
        tube.radius = c.radius;
        tube.length = c.length;
        const Surface s = lambertian(c.normal);
        const double expected = lambertIrradiance(outlineOf(tube), s.normal);
        EXPECT_GT(expected, 0);
        EXPECT_NEAR(irradianceBy(tube, s), expected, exact * expected) << &c - cases.data();
    }
}

// In the limit of radius r to 0, an infinite tube at distance d gives E = pi r L / d on a surface facing
// it.
TEST(ReferenceClosedForms, ALongThinTubeIsALine) {
    Light tube = lightOf(LightKind::tube, {0, 0, 2});
    tube.axis = {0, 1, 0};
    tube.radius = 1e-4f;
    tube.length = 2e4f;
    expectRelative(irradianceBy(tube, lambertian()), pi * 1e-4 / 2, 1e-6);
}

TEST(ReferenceClosedForms, ATubeBelowTheHorizonOrAroundThePlaceIsDark) {
    Light tube = lightOf(LightKind::tube, {0.3, 0, -1});
    tube.radius = 0.5f;
    EXPECT_EQ(irradianceBy(tube, lambertian()), 0);
    tube.position = {0.1, 0, 0.1};
    EXPECT_EQ(irradianceBy(tube, lambertian()), 0) << "a closed surface shines outwards";
}

// ---- a sun -------------------------------------------------------------------------------------------

TEST(ReferenceClosedForms, ASunsIlluminanceDoesNotDependOnItsAngle) {
    for (const float angle : {0.0f, 1e-4f, 0.0093f, 0.5f, 2.0f, 3.1f}) {
        Light sun = lightOf(LightKind::directional, {0, 0, 0}, {0, 0, -1});
        sun.angle = angle;
        sun.intensity = 7;
        expectRelative(irradianceBy(sun, lambertian()), 7);
        // A disc entirely above the horizon has the irradiance of its centre.
        if (angle < 1) expectRelative(irradianceBy(sun, lambertian({1, 0, 1})), 7 / std::sqrt(2.0));
    }
}

// Only the part above the horizon counts.
TEST(ReferenceClosedForms, ASunOnTheHorizon) {
    for (const double lift : {-0.05, 0.0, 0.03}) {
        Light sun = lightOf(LightKind::directional, {0, 0, 0}, {-1, 0, -lift});
        sun.angle = 0.2f;
        const glm::dvec3 towards = -sun.direction;
        const double radius = std::tan(double{sun.angle} / 2);
        std::vector<glm::dvec3> outline;
        addArc(outline, towards, glm::dvec3(0, radius, 0), glm::cross(towards, glm::dvec3(0, radius, 0)), 0,
               2 * pi);
        const double radiance = 1 / (pi * std::pow(std::sin(double{sun.angle} / 2), 2));
        expectRelative(irradianceBy(sun, lambertian()), radiance * lambertIrradiance(outline, {0, 0, 1}));
    }
}

// On a sufficiently rough surface a small disc equals a directional light; the difference is proportional
// to the squared angle.
TEST(ReferenceClosedForms, ASunsDiscGoesToADirection) {
    Surface s = mirror(0.5, 0.7);
    s.metallic = 0.5;
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    Light sun = lightOf(LightKind::directional, {0, 0, 0}, {0.4, 0.1, -1});
    const double direction = reflectedBy(sun, s);
    sun.angle = 0.02f;
    const double wide = std::abs(reflectedBy(sun, s) - direction);
    sun.angle = 0.01f;
    const double narrow = std::abs(reflectedBy(sun, s) - direction);
    EXPECT_LT(wide, 1e-3 * direction);
    EXPECT_NEAR(wide / narrow, 4, 0.05);
}

// ---- point and spot ----------------------------------------------------------------------------------

TEST(ReferenceClosedForms, APointFallsOffWithTheSquare) {
    for (const double distance : {1e-3, 0.5, 2.0, 1e4}) {
        Light point = lightOf(LightKind::point, {distance * 0.6, 0, distance * 0.8});
        point.intensity = 5;
        expectRelative(irradianceBy(point, lambertian()), 5 * 0.8 / (distance * distance), 1e-12);
    }
    Light at = lightOf(LightKind::point, {0, 0, 0});
    EXPECT_EQ(irradianceBy(at, lambertian()), 0) << "in its own place";
}

// KHR_lights_punctual (Khronos 2019): saturate((cos a - cos outer) / max(0.001, cos inner - cos outer))^2.
TEST(ReferenceClosedForms, ASpotsCones) {
    Light spot = lightOf(LightKind::spot, {0, 0, 0});
    spot.inner_cone = 0.3f;
    spot.outer_cone = 0.6f;
    const auto factor = [&](double angle, SpotFalloff cone = SpotFalloff::gltf) {
        const Incident light =
            incident(spot, {0, 0, 0}, 2.0 * glm::dvec3(std::sin(angle), 0, -std::cos(angle)), {.cone = cone});
        return light.irradiance.g * 4;
    };
    const double inner = std::cos(double{spot.inner_cone}), outer = std::cos(double{spot.outer_cone});
    EXPECT_NEAR(factor(0), 1, 1e-15);
    EXPECT_NEAR(factor(0.2999), 1, 1e-15);
    EXPECT_NEAR(factor(0.45), std::pow((std::cos(0.45) - outer) / (inner - outer), 2), 1e-14);
    EXPECT_EQ(factor(0.6001), 0);
    EXPECT_EQ(factor(pi), 0);
    const double t = (std::cos(0.45) - outer) / (inner - outer);
    EXPECT_NEAR(factor(0.45, SpotFalloff::smoothstep), t * t * (3 - 2 * t), 1e-14);
    EXPECT_NEAR(factor(0.2999, SpotFalloff::smoothstep), 1, 1e-15);
    EXPECT_EQ(factor(0.6001, SpotFalloff::smoothstep), 0);
    spot.inner_cone = spot.outer_cone;  // a hard edge keeps a slope of 1000
    EXPECT_NEAR(factor(0.5995), std::min(1.0, std::pow((std::cos(0.5995) - outer) * 1000, 2)), 1e-12);
    EXPECT_LT(factor(0.5995), 0.9);
}

}  // namespace
}  // namespace diptych::reference
