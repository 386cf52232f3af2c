// SPDX-License-Identifier: MIT
// Closed form and ray march of haze in the shaders, compared with the reference's quadrature.
#include "compare/reference/light/haze.h"
#include "shared/contract/features.h"
#include "shared/environment/haze.h"
#include "tests/probe/probe.h"
#include "tests/support/haze_builder.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace diptych {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr std::size_t airWidth = 36;

// Ray through the medium: height of its origin (m), direction, length (m).
struct Ray {
    double height;
    glm::dvec3 away;
    double reach;
};

// Rays that share one feature value, shaded in one dispatch.
class AirProbe {
public:
    void add(const Settings& settings, const Light* sun, const Ray& ray) {
        const HazeNumbers numbers = hazeNumbers(settings, sun, {0, ray.height, 0});
        feature_ = numbers.feature;
        append(std::bit_cast<std::array<float, 20>>(numbers.haze));
        append(std::bit_cast<std::array<float, 12>>(numbers.march));
        const auto reach = static_cast<float>(std::isinf(ray.reach) ? -1 : ray.reach);
        append(std::array{static_cast<float>(ray.away.x), static_cast<float>(ray.away.y),
                          static_cast<float>(ray.away.z), reach});
    }
    std::vector<reference::Hazed> run() {
        Probes probes;
        const std::vector<float> out =
            probes.run("air", input_, airWidth, 6, {{gpu::FEATURE_haze, feature_}});
        std::vector<reference::Hazed> all;
        for (std::size_t i = 0; i < out.size(); i += 6)
            all.push_back({{double{out[i]}, double{out[i + 1]}, double{out[i + 2]}},
                           {double{out[i + 3]}, double{out[i + 4]}, double{out[i + 5]}}});
        return all;
    }

private:
    template <std::size_t N>
    void append(const std::array<float, N>& numbers) {
        input_.insert(input_.end(), numbers.begin(), numbers.end());
    }
    gpu::uint feature_ = 0;
    std::vector<float> input_;
};

double apart(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = glm::abs(a - b);
    const double max = std::max({d.x, d.y, d.z});
    return std::isnan(d.x + d.y + d.z) ? endless : max;
}

// Rays of thin and thick air, from below height 0 to far above, up, down, level and almost level, from a
// millimetre to a thousand kilometres and infinite.
std::vector<Ray> raysOf(double height_scale, int count, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1), place(-1, 8), turn(0, 6.28);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const double tiny = std::pow(10, -9 + 8 * unit(random)) * (i % 2 == 0 ? 1 : -1);
        const double up = i % 7 == 0 ? 0 : i % 3 == 0 ? tiny : 2 * unit(random) - 1;
        const double across = std::sqrt(1 - up * up), phi = turn(random);
        const double reach = i % 4 == 0 ? endless : std::pow(10, -3 + 9 * unit(random));
        const glm::dvec3 away(across * std::cos(phi), up, across * std::sin(phi));
        rays.push_back({double{static_cast<float>(height_scale * place(random))}, glm::dvec3(glm::vec3(away)),
                        double{static_cast<float>(reach)}});
    }
    return rays;
}

struct Medium {
    const char* name;
    float density, rayleigh_height, mie_height, g;
};
constexpr std::array media{
    Medium{"the earth's", 1, 8000, 1200, 0.76f}, Medium{"a hundred times as thick", 100, 8000, 1200, 0.76f},
    Medium{"fog on the ground", 3000, 20, 5, 0.3f}, Medium{"next to nothing", 1e-6f, 8000, 1200, -0.5f},
    Medium{"everywhere the same", 10, 1e9f, 1e9f, 0}};
Settings settingsOf(const Medium& medium) {
    Settings settings = hazeSettings(medium.density);
    settings.haze_rayleigh_height = medium.rayleigh_height;
    settings.haze_mie_height = medium.mie_height;
    settings.haze_g = medium.g;
    return settings;
}
// Irradiance of the sun: source radiance stays below 1 W/(sr m^2), so absolute errors of 1e-6 are relevant.
constexpr float modestSun = 0.3f;

TEST(Air, ClosedFormIsTheIntegral) {
    std::mt19937 random(5);
    const Light sun = sunTowards({0.3, -0.6, -1}, modestSun);
    for (const Medium& medium : media) {
        Settings settings = settingsOf(medium);
        settings.ambient = {0.1f, 0.2f, 0.3f};
        const reference::Air air = airOfSettings(settings, &sun);
        const std::vector<Ray> rays = raysOf(std::min(double{medium.mie_height}, 1e4), 400, random);
        AirProbe probe;
        for (const Ray& ray : rays) probe.add(settings, &sun, ray);
        const std::vector<reference::Hazed> hazed = probe.run();
        double max = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const reference::Hazed truth =
                reference::Haze(air, {0, rays[i].height, 0}).along({}, rays[i].away, rays[i].reach);
            const std::string what = fmt::format("{} {}: from {} up {} over {}", medium.name, i,
                                                 rays[i].height, rays[i].away.y, rays[i].reach);
            EXPECT_LT(apart(hazed[i].transmittance, truth.transmittance), 1e-6) << what;
            EXPECT_LT(apart(hazed[i].scattered, truth.scattered), 1e-6) << what;
            // Relative to the scattered radiance, however small it is.
            EXPECT_LT(apart(hazed[i].scattered, truth.scattered),
                      1e-5 * std::max({truth.scattered.x, truth.scattered.y, truth.scattered.z}) + 1e-30)
                << what;
            max = std::max(max, apart(hazed[i].transmittance, glm::dvec3(1)));
        }
        EXPECT_GT(max, medium.density < 1e-3f ? 1e-7 : 0.1) << medium.name << ": rays that see it";
    }
}

TEST(Air, TwoStretchesLetThroughWhatTheWholeDoes) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const Medium& medium : media) {
        const Settings settings = settingsOf(medium);
        AirProbe probe;
        std::vector<bool> back;
        for (const Ray& ray : raysOf(std::min(double{medium.mie_height}, 1e4), 300, random)) {
            const double whole = std::isinf(ray.reach) ? 1000 : ray.reach;
            const double first = whole * unit(random);
            probe.add(settings, nullptr, {ray.height, ray.away, whole});
            probe.add(settings, nullptr, {ray.height, ray.away, first});
            probe.add(settings, nullptr, {ray.height + ray.away.y * first, ray.away, whole - first});
            // Reverse the ray only if the density at its end is exact enough for a float32 height.
            const double end = ray.height + ray.away.y * whole;
            const bool known = std::abs(end) < 10 * double{medium.mie_height};
            back.push_back(known);
            probe.add(settings, nullptr, {known ? end : 0, -ray.away, whole});
        }
        const std::vector<reference::Hazed> hazed = probe.run();
        for (std::size_t i = 0; i < hazed.size(); i += 4) {
            const glm::dvec3 whole = hazed[i].transmittance;
            EXPECT_LT(apart(whole, hazed[i + 1].transmittance * hazed[i + 2].transmittance), 1e-6)
                << medium.name << i;
            if (back[i / 4]) {
                EXPECT_LT(apart(whole, hazed[i + 3].transmittance), 1e-6) << medium.name << i << ", back";
            }
        }
        EXPECT_GT(std::ranges::count(back, true), 100);
    }
}

// From 1e-3 below the horizon to 1e-3 above it, including exactly level.
TEST(Air, ThereIsNoBandAtTheHorizon) {
    const Light sun = sunTowards({0.3, -0.6, -1}, modestSun);
    for (const double reach : {1e3, 1e5, endless})
        for (const int steps : {0, 16}) {
            Settings settings = hazeSettings(5);
            settings.haze_march_steps = steps;
            AirProbe probe;
            std::vector<double> ups;
            for (int i = -200; i <= 200; ++i) {
                const double up = i * std::abs(i) / 4e4 * 1e-3;  // to 1e-3, denser towards 0
                ups.push_back(up);
                probe.add(settings, &sun,
                          {2, glm::dvec3(glm::vec3(glm::normalize(glm::dvec3(0.6, up, 0.8)))), reach});
            }
            const std::vector<reference::Hazed> hazed = probe.run();
            for (std::size_t i = 1; i < hazed.size(); ++i) {
                // Radiance changes by less than its own magnitude over 5 degrees.
                const double max = 1e-6 + 10 * (ups[i] - ups[i - 1]);
                EXPECT_LT(apart(hazed[i].scattered, hazed[i - 1].scattered), max)
                    << reach << " " << steps << " " << ups[i];
                EXPECT_LT(apart(hazed[i].transmittance, hazed[i - 1].transmittance), max)
                    << reach << " " << steps << " " << ups[i];
            }
            if (std::isinf(reach)) {
                EXPECT_LT(apart(hazed[200].transmittance, {0, 0, 0}), 1e-30);
                EXPECT_LT(apart(hazed[0].transmittance, {0, 0, 0}), 1e-30);
            }
        }
}

// If the source is constant along the ray, one step equals the closed form.
TEST(Air, AMarchThroughEvenAirIsTheClosedForm) {
    std::mt19937 random(8);
    for (const Medium& medium : media) {
        Settings settings = settingsOf(medium);
        settings.haze_rayleigh_height = settings.haze_mie_height;
        settings.ambient = {0.5f, 0.25f, 0.125f};
        const std::vector<Ray> rays = raysOf(std::min(double{medium.mie_height}, 1e4), 200, random);
        AirProbe closed;
        for (const Ray& ray : rays) closed.add(settings, nullptr, ray);
        const std::vector<reference::Hazed> expected = closed.run();
        for (const int steps : {1, 7}) {
            settings.haze_march_steps = steps;
            AirProbe marched;
            for (const Ray& ray : rays) marched.add(settings, nullptr, ray);
            const std::vector<reference::Hazed> hazed = marched.run();
            for (std::size_t i = 0; i < rays.size(); ++i) {
                EXPECT_LT(apart(hazed[i].transmittance, expected[i].transmittance), 1e-6) << medium.name << i;
                EXPECT_LT(apart(hazed[i].scattered, expected[i].scattered), 1e-6) << medium.name << i;
            }
        }
    }
}

// Transmittance is exact; scattered radiance converges to the integral with more steps. Skips rays that go
// deep below height 0, where the step distribution is worse.
TEST(Air, AMarchComesToTheIntegral) {
    std::mt19937 random(9);
    const Light sun = sunTowards({0.3, -0.6, -1}, modestSun);
    for (const Medium& medium : media) {
        Settings settings = settingsOf(medium);
        settings.ambient = {0.1f, 0.1f, 0.1f};
        std::vector<Ray> rays = raysOf(std::min(double{medium.mie_height}, 1e4), 400, random);
        std::erase_if(rays, [&](const Ray& ray) {
            const double rise =
                std::isinf(ray.reach) ? (ray.away.y < 0 ? -endless : 0) : ray.away.y * ray.reach;
            return ray.height + rise < -double{medium.mie_height};
        });
        EXPECT_GT(rays.size(), 200u) << medium.name;
        std::vector<reference::Hazed> truth;
        settings.haze_march_steps = 1;
        const reference::Air air = airOfSettings(settings, &sun);
        for (const Ray& ray : rays)
            truth.push_back(reference::Haze(air, {0, ray.height, 0}).along({}, ray.away, ray.reach));
        // Measured: at most 2.8e-4, 1.0e-4 and 7e-6 W/(sr m^2).
        for (const auto& [steps, allowed] : {std::pair(8, 6e-4), std::pair(32, 2e-4), std::pair(256, 2e-5)}) {
            settings.haze_march_steps = steps;
            AirProbe probe;
            for (const Ray& ray : rays) probe.add(settings, &sun, ray);
            const std::vector<reference::Hazed> hazed = probe.run();
            double max = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                EXPECT_LT(apart(hazed[i].transmittance, truth[i].transmittance), 1e-6) << medium.name << i;
                max = std::max(max, apart(hazed[i].scattered, truth[i].scattered));
            }
            EXPECT_LT(max, allowed) << medium.name << " " << steps;
        }
    }
}

// A ray that descends very slowly is infinite, and the march ends where transmittance is negligible: 0.2
// to 1 scale height below the origin.
TEST(Air, AMarchAlmostAlongTheHorizonComesToTheIntegral) {
    const Light sun = sunTowards({0.3, -0.6, -1}, modestSun);
    for (const Medium& medium : {media[0], media[2]}) {
        Settings settings = settingsOf(medium);
        settings.ambient = {0.1f, 0.1f, 0.1f};
        settings.haze_march_steps = 64;
        const reference::Air air = airOfSettings(settings, &sun);
        // Largest depth of an infinite ray, in metres of air at height 0.
        const HazeNumbers numbers = hazeNumbers(settings, &sun, {0, 0, 0});
        const double max = double{gpu::HAZE_ENDLESS_DEPTH} / double{numbers.haze.extinction.x},
                     scale = 1 / double{numbers.haze.inverse_height};
        AirProbe probe;
        std::vector<reference::Hazed> truth;
        for (const double height : {0.0, 1.0, 2.0, 4.0})
            for (const double fall : {0.2, 0.5, 1.0, 1.5}) {
                // Slope for which a ray accumulates `max` while density grows by e^fall.
                const double up = -std::exp(-height) * std::expm1(fall) * scale / max;
                const glm::dvec3 away(glm::vec3(std::sqrt(1 - up * up), up, 0));
                const Ray ray{double{static_cast<float>(height * scale)}, away, endless};
                probe.add(settings, &sun, ray);
                truth.push_back(reference::Haze(air, {0, ray.height, 0}).along({}, ray.away, ray.reach));
            }
        const std::vector<reference::Hazed> hazed = probe.run();
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double light = std::max({truth[i].scattered.x, truth[i].scattered.y, truth[i].scattered.z});
            EXPECT_GT(light, 0.05) << medium.name << i;
            // Measured: at most 1.7e-5 W/(sr m^2).
            EXPECT_LT(apart(hazed[i].scattered, truth[i].scattered), 3e-5) << medium.name << i;
        }
    }
}

}  // namespace
}  // namespace diptych
