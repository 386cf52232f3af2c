// SPDX-License-Identifier: MIT
// The reference's lights of every kind on a white plane, compared with closed forms.
#include "tests/support/light_kinds.h"
#include "tests/support/reference_builder.h"

#include "compare/reference/light/punctual.h"

namespace diptych::reference {
namespace {

// The quadrature's tolerance is 2e-6 of the integral; the actual error is far smaller.
constexpr double exact = 1e-6;

void expectRelative(double value, double expected, double tolerance = exact) {
    EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

// A light, the normal of the surface at the origin, and the error of its irradiance, relative.
struct LitPlace {
    Light light;
    glm::dvec3 normal{0, 0, 1};
    double tolerance = exact;
};

std::vector<LitPlace> suns() {
    std::vector<LitPlace> places;
    for (const float angle : {0.0f, 1e-4f, 0.0093f, 0.5f, 2.0f, 3.1f}) {
        Light sun = lightOf(LightKind::directional, {0, 0, 0}, {0, 0, -1});
        sun.angle = angle;
        sun.intensity = 7;
        places.push_back({sun});
        if (angle < 1) places.push_back({sun, {1, 0, 1}});
    }
    for (const double lift : {-0.05, 0.0, 0.03}) {  // on the horizon
        Light sun = lightOf(LightKind::directional, {0, 0, 0}, {-1, 0, -lift});
        sun.angle = 0.2f;
        places.push_back({sun});
    }
    return places;
}

std::vector<LitPlace> points() {
    std::vector<LitPlace> places;
    for (const double distance : {0.0, 1e-3, 0.5, 2.0, 1e4}) {
        Light point = lightOf(LightKind::point, {distance * 0.6, 0, distance * 0.8});
        point.intensity = 5;
        places.push_back({point, {0, 0, 1}, 1e-12});
    }
    return places;
}

// The surface faces the light. A hard edge keeps a slope of 1000.
std::vector<LitPlace> spots() {
    std::vector<LitPlace> places;
    for (const bool hard : {false, true})
        for (const double angle : {0.0, 0.2999, 0.45, 0.5995, 0.6001, pi}) {
            Light spot = lightOf(LightKind::spot, 2.0 * glm::dvec3(-std::sin(angle), 0, std::cos(angle)));
            spot.outer_cone = 0.6f;
            spot.inner_cone = hard ? 0.6f : 0.3f;
            places.push_back({spot, spot.position, hard ? 1e-11 : 1e-12});
        }
    return places;
}

std::vector<LitPlace> rectangles() {
    std::vector<LitPlace> places;
    for (const glm::dvec3 normal :
         {glm::dvec3(0, 0, 1), {1, 0, 0}, {0.7, -0.7, 0.1}, {-1, 2, 0.4}, {0.3, 1, -0.1}})
        for (const glm::dvec3 direction : {glm::dvec3(0, 0, -1), {0.5, 0.2, -1}, {0.3, -0.9, -0.4}})
            for (const double distance : {0.2, 1.0, 30.0}) {
                Light rect = lightOf(LightKind::rect, {0.1 * distance, 0.2 * distance, distance}, direction);
                rect.width = 1.5f;
                rect.height = 0.5f;
                places.push_back({rect, normal});
            }
    // Large and near: most of the light arrives from a millionth of the area.
    for (const double height : {1e-4, 1e-2}) {
        Light rect = lightOf(LightKind::rect, {31, 17, height});
        rect.width = rect.height = 100;
        places.push_back({rect});
        rect.position = {31, height, 0};  // the lower half is below the horizon
        rect.direction = {0, -1, 0};
        rect.axis = {1, 0, 0};
        places.push_back({rect, {0, 0.01, 1}});
    }
    return places;
}

std::vector<LitPlace> discs() {
    std::vector<LitPlace> places;
    const auto add = [&](const Light& light, float radius, const glm::dvec3& normal = {0, 0, 1}) {
        places.push_back({light, normal});
        places.back().light.radius = radius;
    };
    for (const float radius : {0.001f, 0.25f, 1.0f, 40.0f}) add(lightOf(LightKind::disc, {0, 0, 2}), radius);
    for (const double aside : {0.0, 0.3, 1.0, 1.5, 7.0})
        for (const double height : {0.05, 0.8, 3.0}) add(lightOf(LightKind::disc, {aside, 0, height}), 1);
    for (const glm::dvec3 normal :
         {glm::dvec3(0, 0, 1), {1, 0, 0}, {1, 0.3, 0.2}, {-0.5, -1, 0.7}, {1, 0, 0.001}})
        add(lightOf(LightKind::disc, {0.4, 0.1, 1.2}, {0.3, -0.2, -1}), 0.75f, normal);
    return places;
}

std::vector<LitPlace> tubes() {
    std::vector<LitPlace> places;
    const auto add = [&](const glm::dvec3& position, const glm::dvec3& axis, const glm::dvec3& normal,
                         float radius, float length) {
        places.push_back({lightOf(LightKind::tube, position), normal});
        Light& tube = places.back().light;
        tube.axis = glm::normalize(axis);
        tube.radius = radius;
        tube.length = length;
    };
    add({0, 0, 1}, {1, 0, 0}, {0, 0, 1}, 0.1f, 1);          // above
    add({0, 0, 1}, {1, 0, 0}, {0, 0, 1}, 0.9f, 3);          // thick and near
    add({3, 0, 1}, {1, 0, 0}, {0, 0, 1}, 0.3f, 2);          // beside its end, which is visible
    add({1.5, 0.1, 0}, {1, 0, 0}, {1, 0, 0.2}, 0.4f, 2);    // on its axis: only the cap is visible
    add({0, 0, 2}, {0.2, 0.1, 1}, {0, 0, 1}, 0.25f, 1);     // cap and side
    add({0.7, 0.4, 0.2}, {0, 0.3, 1}, {0, 0, 1}, 0.2f, 3);  // the axis crosses the horizon
    add({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.3f, 1);          // the axis lies on the horizon
    add({0.6, -0.2, 0.5}, {1, 0, -1}, {0.3, 0, 1}, 0.1f, 4);
    add({0, 0, 5}, {1, 0, 0}, {0, 0, 1}, 0.001f, 100);
    add({0, 0, 2}, {0, 1, 0}, {0, 0, 1}, 1e-4f, 2e4f);  // a line
    add({0.1, 0, 0.1}, {1, 0, 0}, {0, 0, 1}, 0.5f, 1);  // around the surface: shines outwards
    return places;
}

class ReferenceLight : public testing::TestWithParam<LightKind> {
protected:
    static std::vector<LitPlace> places() {
        switch (GetParam()) {
            case LightKind::directional:
                return suns();
            case LightKind::point:
                return points();
            case LightKind::spot:
                return spots();
            case LightKind::rect:
                return rectangles();
            case LightKind::disc:
                return discs();
            case LightKind::tube:
                return tubes();
        }
        ADD_FAILURE() << "a kind of light without places";
        return {};
    }
};

TEST_P(ReferenceLight, HasTheIrradianceOfItsClosedForm) {
    const std::vector<LitPlace> all = places();
    int lit = 0;
    for (const LitPlace& place : all) {
        SCOPED_TRACE(&place - all.data());
        const Surface s = lambertian(place.normal);
        const double expected = irradianceFrom(place.light, s.normal);
        expectRelative(irradianceBy(place.light, s), expected, place.tolerance);
        lit += expected > 0;
    }
    EXPECT_GE(lit, 4);
}

// Directional lights have no range.
TEST_P(ReferenceLight, EndsAtItsRangeExactly) {
    Light light = lightOf(GetParam(), {0, 0, 3});
    const bool ranged = GetParam() != LightKind::directional;
    const double without = irradianceBy(light, lambertian());
    EXPECT_GT(without, 0);
    light.range = 4;
    expectRelative(irradianceBy(light, lambertian()), without * (ranged ? 1 - std::pow(0.75, 4) : 1));
    for (const float range : {3.0f, 2.0f}) {
        light.range = range;
        EXPECT_EQ(irradianceBy(light, lambertian()), ranged ? 0 : without);
    }
}

TEST_P(ReferenceLight, IsWholeInTheOpenAndNothingInTheShade) {
    Light light = lightOf(GetParam(), {0.2, 0.1, 1.5});
    light.angle = 0.1f;
    const std::span one(&light, 1);
    for (const Surface& s : {lambertian(), mirror(0.2, 0.4)}) {
        const double whole = shadedBy(one, s).reflected.size();
        EXPECT_GT(whole, 0);
        EXPECT_NEAR(shadedBy(one, s, [](const glm::dvec3&, double) { return true; }).reflected.size(), whole,
                    1e-6 * whole);
        EXPECT_EQ(shadedBy(one, s, [](const glm::dvec3&, double) { return false; }).reflected.size(), 0);
    }
}

TEST_P(ReferenceLight, DoesNotShineOnASurfaceThatFacesAway) {
    EXPECT_EQ(irradianceBy(lightOf(GetParam(), {0.3, 0, -1}, {0, 0, 1}), lambertian()), 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ReferenceLight, testing::ValuesIn(everyLightKind()), lightKindName);

// ---- single kinds ------------------------------------------------------------------------------------

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

TEST(ReferenceClosedForms, WindowsOfEitherSetting) {
    EXPECT_EQ(rangeWindow(1e9, std::numeric_limits<double>::infinity()), 1);
    EXPECT_EQ(rangeWindow(1e9, std::numeric_limits<double>::infinity(), RangeWindow::squared), 1);
    EXPECT_DOUBLE_EQ(rangeWindow(1, 2, RangeWindow::squared), 0.9375 * 0.9375);
    EXPECT_EQ(rangeWindow(2, 2, RangeWindow::squared), 0);
}

TEST(ReferenceClosedForms, ConesOfEitherSetting) {
    Light spot = lightOf(LightKind::spot, {0, 0, 0});
    spot.inner_cone = 0.3f;
    spot.outer_cone = 0.6f;
    const auto factor = [&](double angle, SpotFalloff cone) {
        const Incident light =
            incident(spot, {0, 0, 0}, 2.0 * glm::dvec3(std::sin(angle), 0, -std::cos(angle)), {.cone = cone});
        return light.irradiance.g * 4;
    };
    const double t = coneFactor(double{spot.inner_cone}, double{spot.outer_cone}, std::cos(0.45));
    EXPECT_NEAR(factor(0.45, SpotFalloff::gltf), t * t, 1e-14);
    EXPECT_NEAR(factor(0.45, SpotFalloff::smoothstep), t * t * (3 - 2 * t), 1e-14);
    for (const SpotFalloff each : {SpotFalloff::gltf, SpotFalloff::smoothstep}) {
        EXPECT_NEAR(factor(0, each), 1, 1e-15);
        EXPECT_NEAR(factor(0.2999, each), 1, 1e-15);
        EXPECT_EQ(factor(0.6001, each), 0);
        EXPECT_EQ(factor(pi, each), 0);
    }
}

}  // namespace
}  // namespace diptych::reference
