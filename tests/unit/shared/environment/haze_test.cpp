// SPDX-License-Identifier: MIT
// The reference's haze integral, compared with known values, and the shaders' constants.
#include "compare/reference/light/haze.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"
#include "shared/environment/haze.h"
#include "tests/support/haze_builder.h"

#include <gtest/gtest.h>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace diptych {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

reference::Hazed seen(const reference::Air& air, double height, const glm::dvec3& away, double reach) {
    return reference::Haze(air, {0, height, 0}).along({}, glm::normalize(away), reach);
}
void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance, const char* what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << what << " " << c;
}

// Two scale heights. Straight up, the optical depth is extinction times height; level, it is extinction
// times length. An infinite level ray transmits nothing.
TEST(Haze, ColumnsOfTheReference) {
    Settings settings = hazeSettings(20);
    settings.haze_march_steps = 1;
    const reference::Air air = airOfSettings(settings, nullptr);
    const glm::dvec3 m = air.molecules.extinction, a = air.aerosols.extinction;
    for (const double height : {0.0, 3000.0, -500.0}) {
        const double rm = std::exp(-height / 8000), ra = std::exp(-height / 1200);
        expectNear(seen(air, height, {0, 1, 0}, forever).transmittance,
                   glm::exp(-(m * (8000 * rm) + a * (1200 * ra))), 1e-12, "up");
        expectNear(seen(air, height, {1, 0, 0}, 5000).transmittance, glm::exp(-(m * rm + a * ra) * 5000.0),
                   1e-12, "level");
        for (const double up : {0.0, -0.5})
            expectNear(seen(air, height, {1, up, 0}, forever).transmittance, {0, 0, 0}, 0, "endless");
        const double slope = std::sqrt(0.5), top = height + 4000 * slope;
        const glm::dvec3 depth =
            (m * (8000 * (rm - std::exp(-top / 8000))) + a * (1200 * (ra - std::exp(-top / 1200)))) / slope;
        expectNear(seen(air, height, {1, 1, 0}, 4000).transmittance, glm::exp(-depth), 1e-12, "slanting");
        // The same ray downwards.
        expectNear(seen(air, top, {1, -1, 0}, 4000).transmittance, glm::exp(-depth), 1e-12, "down");
    }
}

// In ambient light, thick air without absorption has the radiance of that light.
TEST(Haze, ThickWhiteAirShinesAsWhatIsAroundIt) {
    Settings settings = hazeSettings(1000);
    settings.haze_mie = {};
    settings.ambient = {1, 2, 3};
    for (const int steps : {0, 1}) {
        settings.haze_march_steps = steps;
        const reference::Air air = airOfSettings(settings, nullptr);
        expectNear(seen(air, 10, {1, 0, 0}, forever).scattered, {1, 2, 3}, 1e-12, "endless");
        const reference::Hazed some = seen(air, 10, {1, 0.2, 0}, 100);
        expectNear(some.scattered, glm::dvec3(1, 2, 3) * (1.0 - some.transmittance), 1e-12, "some");
    }
}

// Phase functions integrate to 1: for a level ray through thin air in each direction, scattered =
// extinction * length * phase.
TEST(Haze, PhaseFunctionsIntegrateToOne) {
    const Light sun = sunTowards({0, -1, 0}, 1);
    for (const bool molecules : {true, false}) {
        Settings settings = hazeSettings(1e-6f);
        settings.haze_mie_height = settings.haze_rayleigh_height = 1e9f;
        if (molecules)
            settings.haze_mie = {};
        else
            settings.haze_rayleigh = {};
        const reference::Air air = airOfSettings(settings, &sun);
        const glm::dvec3 scattering = air.molecules.scattering + air.aerosols.scattering;
        double sum = 0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double cosine = -1 + 2 * (i + 0.5) / steps;
            const reference::Hazed hazed = seen(air, 0, {std::sqrt(1 - cosine * cosine), cosine, 0}, 1);
            sum += 2 * std::numbers::pi * hazed.scattered.x / scattering.x * 2 / steps;
        }
        // Except for the little light that the air above absorbs: 3e-8 of 1e9 m.
        EXPECT_NEAR(sum, 1, molecules ? 0.01 : 0.03);
    }
}

TEST(Haze, TheSunIsDimmedByTheAirAboveTheCameraOrAboveEachPlace) {
    const Light sun = sunTowards({0, -1, -1}, 2);
    Settings settings = hazeSettings(10);
    for (const int steps : {0, 1}) {
        settings.haze_march_steps = steps;
        settings.haze_mie_height = settings.haze_rayleigh_height = 1000;
        const reference::Air air = airOfSettings(settings, &sun);
        const glm::dvec3 all = air.molecules.extinction + air.aerosols.extinction;
        const auto fraction = [&](double height) {
            return glm::exp(-all * (1000 * std::exp(-height / 1000) * std::sqrt(2.0)));
        };
        // Two short rays (the direction to the sun is float32): the second starts higher but has the same
        // direction and camera.
        const reference::Haze haze(air, {0, 500, 0});
        const glm::dvec3 low = haze.along({0, 0, 0}, {1, 0, 0}, 1e-3).scattered,
                         high = haze.along({0, 700, 0}, {1, 0, 0}, 1e-3).scattered;
        const glm::dvec3 expected =
            steps == 0 ? glm::dvec3(std::exp(-0.7)) : std::exp(-0.7) * fraction(1200) / fraction(500);
        expectNear(high / low, expected, 1e-7, steps == 0 ? "one sun" : "each place's");
    }
}

// Raising ground and camera together changes nothing, here or in the reference.
TEST(Haze, HeightsCountFromTheGround) {
    const Light sun = sunTowards({0.3, -0.6, -1}, 3);
    for (const int steps : {0, 16}) {
        Settings level = hazeSettings(20), lifted = level;
        level.haze_march_steps = lifted.haze_march_steps = steps;
        lifted.haze_ground = 2048;
        const HazeNumbers a = hazeNumbers(level, &sun, {0, 512, 0}),
                          b = hazeNumbers(lifted, &sun, {0, 2560, 0});
        EXPECT_EQ(std::memcmp(&a.haze, &b.haze, sizeof a.haze), 0) << steps;
        EXPECT_EQ(std::memcmp(&a.march, &b.march, sizeof a.march), 0) << steps;
        const reference::Haze low(airOfSettings(level, &sun), {0, 512, 0}),
            high(airOfSettings(lifted, &sun), {0, 2560, 0});
        const glm::dvec3 away = glm::normalize(glm::dvec3(1, -0.1, 0.5));
        EXPECT_LT(glm::length(low.along({}, away, 4000).scattered - high.along({}, away, 4000).scattered),
                  1e-12);
    }
}

TEST(Haze, ThereIsNoneWithoutDensityOrWithoutAnythingThatScatters) {
    const Light sun = sunTowards({0, -1, 0}, 1);
    EXPECT_EQ(hazeNumbers({}, &sun, {}).feature, 0u);
    Settings settings = hazeSettings(0);
    EXPECT_EQ(hazeNumbers(settings, &sun, {}).feature, 0u);
    settings.haze_density = 1;
    EXPECT_EQ(hazeNumbers(settings, &sun, {}).feature, gpu::HAZE_THERE | gpu::HAZE_SUN);
    EXPECT_EQ(hazeNumbers(settings, nullptr, {}).feature, gpu::HAZE_THERE);
    settings.ambient = {0, 0, 1};
    settings.haze_march_steps = 4;
    EXPECT_EQ(hazeNumbers(settings, nullptr, {}).feature,
              gpu::HAZE_THERE | gpu::HAZE_MARCHED | gpu::HAZE_AMBIENT);
    const Light set = sunTowards({1, 0, 0}, 1);
    EXPECT_EQ(hazeNumbers(settings, &set, {}).feature & gpu::HAZE_SUN, 0u) << "it is not above the horizon";
    settings.haze_mie = settings.haze_rayleigh = {};
    EXPECT_EQ(hazeNumbers(settings, &sun, {}).feature, 0u);
}

// A single scale height preserves the column above height 0, summed over the colours.
TEST(Haze, OneHeightKeepsTheColumn) {
    const Settings settings = hazeSettings(3);
    const HazeNumbers numbers = hazeNumbers(settings, nullptr, {0, 100, 0});
    const glm::vec3 e = numbers.haze.extinction;
    const double column = double{e.x + e.y + e.z} / double{numbers.haze.inverse_height};
    const double molecules = 3 * (5.8e-6 + 13.5e-6 + 33.1e-6), aerosols = 3 * 6e-5 / 0.9;
    EXPECT_NEAR(column, molecules * 8000 + aerosols * 1200, 1e-5 * column);
    EXPECT_FLOAT_EQ(numbers.haze.camera_height, 100);
}

// A march may have an error proportional to the scattered light, smaller with more steps; a closed form
// may not.
TEST(Haze, OfAMarchSomeErrorIsGranted) {
    Frame reference, path;
    reference.settings.path = Path::reference;
    reference.channels[Channel::lit] = Image(1, 1, 3, 2.0f);
    reference.channels[Channel::lit_haze] = Image(1, 1, 3, 1.0f);
    path.settings = hazeSettings(1);
    path.channels[Channel::lit] = Image(1, 1, 3, 2.0625f);
    path.channels[Channel::lit_haze] = Image(1, 1, 3, 1.0625f);
    const Requirements needs;
    const Coverage coverage = everyPixel(1);
    const FramePair pair{reference, path, needs, coverage};
    const auto excess = [&](Channel channel) {
        const auto errors = certainErrors(debugMode(channel), pair);
        return errors ? errors->at(0) : -1.0;
    };
    EXPECT_EQ(excess(Channel::lit_haze), -1) << "judged as it is";
    path.settings.haze_march_steps = 4;
    EXPECT_NEAR(excess(Channel::lit_haze), 0.0625 - 0.025, 1e-6);
    EXPECT_NEAR(excess(Channel::lit), (0.0625 - 0.025) / 2, 1e-6);
    path.settings.haze_march_steps = 1;
    EXPECT_EQ(excess(Channel::lit_haze), 0);
    reference.channels.erase(Channel::lit_haze);
    EXPECT_EQ(excess(Channel::lit), 0);
    path.settings.haze = false;
    EXPECT_EQ(excess(Channel::lit), -1);
}

}  // namespace
}  // namespace diptych
