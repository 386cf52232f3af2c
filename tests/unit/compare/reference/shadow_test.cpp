// SPDX-License-Identifier: MIT
// The reference's shadows of area lights, compared with the visible part of their polygon.
#include "tests/support/reference_builder.h"

#include "compare/reference/scattering/sampling.h"

namespace diptych::reference {
namespace {

// A square light of 1 m, 1 m above the origin. An occluder at half the height hides twice its size.
Light squareLight() {
    Light light = lightOf(LightKind::rect, {0, 0, 1});
    light.axis = {1, 0, 0};
    return light;
}

// Hides the part of the square between these bounds.
struct Screen {
    double x0, x1, y0, y1;
    bool operator()(const glm::dvec3& d, double distance) const {
        const glm::dvec3 p = d * (0.5 / d.z);
        return !(distance > 0.5 && 2 * p.x > x0 && 2 * p.x < x1 && 2 * p.y > y0 && 2 * p.y < y1);
    }
};

double part(double x0, double x1, double y0, double y1) {
    return lambertIrradiance({{x0, y0, 1}, {x1, y0, 1}, {x1, y1, 1}, {x0, y1, 1}}, {0, 0, 1}) / pi;
}

struct Record {
    int within = 0, seeds = 0;
    double worst = 0;  // error relative to the uncertainty
    double mean = 0;
};
template <class Expected>
Record recordOf(int seeds, const Surface& s, Expected&& expected) {
    Record record;
    const Light light = squareLight();
    for (int seed = 0; seed < seeds; ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const auto [screen, value] = expected(random);
        const Shading shading =
            shadedBy(std::span(&light, 1), s, screen, static_cast<std::uint64_t>(seed) * 104729);
        const double error = std::abs(shading.reflected.diffuse.g + shading.reflected.specular.g - value);
        record.within += error <= shading.uncertainty + 1e-7 * value;
        record.worst = std::max(record.worst, error / (shading.uncertainty + 1e-9));
        record.mean += (shading.reflected.diffuse.g + shading.reflected.specular.g - value) / seeds;
        ++record.seeds;
        // Relative to the unshadowed light: a nearly hidden light does not deserve many samples.
        EXPECT_LE(shading.uncertainty, 1.01 * samplingError * part(-0.5, 0.5, -0.5, 0.5));
    }
    return record;
}

TEST(ReferenceShadow, AnEdgeAcrossARectangle) {
    const double whole = part(-0.5, 0.5, -0.5, 0.5);
    const Record record = recordOf(200, lambertian(), [&](Random& random) {
        const double x = random() - 0.5;
        return std::pair(Visibility(Screen{-9, x, -9, 9}), part(x, 0.5, -0.5, 0.5));
    });
    EXPECT_GE(record.within, record.seeds * 9 / 10);
    EXPECT_LT(record.worst, 4);
    EXPECT_NEAR(record.mean, 0, samplingError / 10 * whole) << "no bias";
}

// Narrow occluders fall between samples; the stated uncertainty must include that.
TEST(ReferenceShadow, WhatIsSmallBeforeALight) {
    for (const double size : {0.02, 0.05, 0.1, 0.2}) {
        const Record record = recordOf(200, lambertian(), [&](Random& random) {
            const double x = (random() - 0.5) * (1 - size), y = (random() - 0.5) * (1 - size);
            const double x0 = x - size / 2, x1 = x + size / 2, y0 = y - size / 2, y1 = y + size / 2;
            return std::pair(Visibility(Screen{x0, x1, y0, y1}),
                             part(-0.5, 0.5, -0.5, 0.5) - part(x0, x1, y0, y1));
        });
        EXPECT_GE(record.within, record.seeds * 9 / 10) << size;
    }
}

// A hole that transmits at least samplingError, a hundredth, is found; smaller ones may be missed.
TEST(ReferenceShadow, ASmallHoleBeforeALight) {
    for (const double size : {0.1, 0.2}) {
        const Record record = recordOf(200, lambertian(), [&](Random& random) {
            const double x = (random() - 0.5) * (1 - size), y = (random() - 0.5) * (1 - size);
            const Screen hole{x - size / 2, x + size / 2, y - size / 2, y + size / 2};
            return std::pair(
                Visibility([hole](const glm::dvec3& d, double distance) { return !hole(d, distance); }),
                part(hole.x0, hole.x1, hole.y0, hole.y1));
        });
        EXPECT_GE(record.within, record.seeds * 9 / 10) << size;
    }
}

// Negative control: a light that is 2 % too bright is outside the stated uncertainty.
TEST(ReferenceShadow, AHundredthIsBeyondTheConfidence) {
    const Record record = recordOf(100, lambertian(), [&](Random& random) {
        const double x = random() * 0.5 - 0.5;
        return std::pair(Visibility(Screen{-9, x, -9, 9}), 1.02 * part(x, 0.5, -0.5, 0.5));
    });
    EXPECT_LE(record.within, record.seeds / 4);
}

TEST(ReferenceShadow, LightsWithoutExtentAreSeenOrNot) {
    std::vector<Light> lights{lightOf(LightKind::point, {0, 0, 2}), lightOf(LightKind::spot, {0, 0, 2}),
                              lightOf(LightKind::directional, {0, 0, 0})};
    std::vector<double> asked;
    const Visibility record = [&](const glm::dvec3& d, double distance) {
        EXPECT_NEAR(d.z, 1, 1e-15);
        asked.push_back(distance);
        return asked.size() != 2;
    };
    const double lit = shadedBy(lights, lambertian(), record).reflected.diffuse.r * pi;
    EXPECT_EQ(asked, (std::vector<double>{2, 2, std::numeric_limits<double>::infinity()}));
    EXPECT_NEAR(lit, 0.25 + 1, 1e-12) << "all but the spot";
}

}  // namespace
}  // namespace diptych::reference
