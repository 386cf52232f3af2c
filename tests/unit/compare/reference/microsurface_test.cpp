// SPDX-License-Identifier: MIT
// The microsurface by random walk: its single reflection is the analytic BRDF, it loses no light, and the
// compensations' distance from it is known.
#include "tests/support/reference_builder.h"

#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/microsurface.h"
#include "compare/reference/scattering/multiscatter.h"

#include <fmt/format.h>

#include <array>

namespace diptych::reference {
namespace {

glm::dvec3 towards(double cosine, double around = 0) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(around), sine * std::sin(around), cosine};
}

Surface metal(double roughness, double cosine, double f0) {
    Surface s = mirror(roughness, std::acos(cosine));
    s.albedo = glm::dvec3(f0);
    return s;
}

// A path in the surface's frame: number of reflections, exit direction and remaining weight.
struct Walk {
    int reflections = 0;
    glm::dvec3 direction{0};
    double weight = 1;
};
Walk walk(double roughness, const glm::dvec3& from, Random& random, double f0 = 1) {
    Walk result;
    result.direction = Microsurface(roughness * roughness)
                           .trace(from, random, [&](const Microsurface::Facet&, double cosine) {
                               ++result.reflections;
                               result.weight *= f0 + (1 - f0) * std::pow(1 - cosine, 5);
                           });
    return result;
}

// An estimate of f(l, v) n.l for two and more reflections.
glm::dvec3 again(const Between& paths, const glm::dvec3& to_light, Random& random) {
    return paths.path(random, [&](const Between::Add& add) { add(to_light, glm::dvec3(1)); }).direct *
           paths.fraction();
}

// Half a 99.99 % confidence interval of the mean of values in [0, 1] with this mean.
double uncertain(double mean, int count) {
    return 3.9 * std::sqrt(mean * (1 - mean) / count);
}

struct Angle {
    double roughness, cosine;
};
constexpr Angle angles[] = {{0.3, 1.0}, {0.3, 0.1},  {0.6, 0.8}, {0.6, 0.05},
                            {0.8, 0.3}, {1.0, 0.95}, {1.0, 0.02}};

// Light that leaves after one reflection is the integral of GGX with height-correlated masking.
TEST(ReferenceMicrosurface, ItsSingleReflectionIsTheBrdf) {
    constexpr int walks = 100'000;
    for (const auto& [roughness, cosine] : angles) {
        Random random(1);
        int once = 0;
        for (int i = 0; i < walks; ++i) once += walk(roughness, towards(cosine), random).reflections == 1;
        const double expected = specularAlbedo(mirror(roughness, std::acos(cosine))).g;
        EXPECT_NEAR(static_cast<double>(once) / walks, expected, uncertain(expected, walks))
            << roughness << " " << cosine;
    }
}

// Every path ends above the surface, at any angle. With F = 1 no light is lost.
TEST(ReferenceMicrosurface, EveryPathLeaves) {
    for (const auto& [roughness, cosine] : angles) {
        Random random(2);
        int longest = 0;
        for (int i = 0; i < 20'000; ++i) {
            const Walk path = walk(roughness, towards(cosine), random);
            ASSERT_GT(path.direction.z, 0);
            ASSERT_NEAR(glm::length(path.direction), 1, 1e-12);
            longest = std::max(longest, path.reflections);
        }
        EXPECT_GT(longest, 1) << roughness;
    }
}

// A white furnace by direction: single reflections by the analytic BRDF, the others by the estimate for
// each light direction. This checks phase function, masking and D against each other.
TEST(ReferenceMicrosurface, AWhiteConductorVanishesInAFurnace) {
    for (const auto& [roughness, cosine] : angles) {
        const Surface s = mirror(roughness, std::acos(cosine));
        const Between paths(s);
        const int walks = static_cast<int>(40'000 * std::min(1.0, 5 * paths.fraction()));
        Random random(3);
        double sum = 0, squares = 0;
        for (int i = 0; i < walks; ++i) {
            // Cosine-weighted.
            const glm::dvec3 l = towards(std::sqrt(1 - random()), 2 * pi * random());
            const double value = again(paths, l, random).g * pi / l.z;
            sum += value;
            squares += value * value;
        }
        const double mean = sum / walks, variance = squares / walks - mean * mean;
        EXPECT_NEAR(mean + specularAlbedo(s).g, 1, 3.9 * std::sqrt(variance / walks))
            << roughness << " " << cosine;
    }
}

TEST(ReferenceMicrosurface, IsReciprocal) {
    constexpr int walks = 40'000;
    const glm::dvec3 a = towards(0.9), b = towards(0.35, 2);
    Surface from_a = mirror(0.7, 0), from_b = from_a;
    from_a.albedo = from_b.albedo = {1, 0.8, 0.3};
    from_a.to_viewer = a;
    from_b.to_viewer = b;
    const Between paths_a(from_a), paths_b(from_b);
    Random random(4);
    glm::dvec3 there(0), back(0);
    for (int i = 0; i < walks; ++i) {
        there += again(paths_a, b, random) / (b.z * walks);
        back += again(paths_b, a, random) / (a.z * walks);
    }
    // The standard deviation of single estimates is less than three times their mean.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c] / back[c], 1, 3.9 * 3 * std::sqrt(2.0 / walks)) << c;
}

// Mean over cosine-weighted views of a white conductor with alpha 1 after one reflection.
TEST(ReferenceMicrosurface, ARoughMirrorReflectsFourTenthsAtOnce) {
    constexpr int walks = 200'000;
    Random random(5);
    int once = 0;
    for (int i = 0; i < walks; ++i)
        once += walk(1, towards(std::sqrt(1 - random())), random).reflections == 1;
    EXPECT_NEAR(static_cast<double>(once) / walks, 0.409, 0.0005 + uncertain(0.409, walks));
}

// The reference with --multiscatter walk: with F = 1 it reflects all ambient light, and of the sun what
// the estimate gives.
TEST(ReferenceMicrosurface, TheReferenceFollowsItForEveryKindOfLight) {
    const auto shaded = [](const Surface& s, std::span<const Light> lights, double ambient) {
        return Lighting(
            {.lights = lights, .ambient = glm::dvec3(ambient), .multiscatter = Multiscatter::walk})(s, {}, 1);
    };
    for (const double metallic : {0.0, 1.0})
        for (const auto& [roughness, cosine] : angles) {
            Surface s = mirror(roughness, std::acos(cosine));
            s.metallic = metallic;
            s.dielectric_f0 = glm::dvec3(0.04);
            s.dielectric_f90 = 1;
            const Shading shading = shaded(s, {}, 1);
            EXPECT_NEAR(shading.ambient.g, 1, 2 * shading.uncertainty + Between::minFraction)
                << roughness << " " << cosine;
            EXPECT_LE(shading.uncertainty, 0.02) << roughness << " " << cosine;
        }
    // A dielectric's base gets the light that its layer transmits; the random walk is a small part.
    Surface s = mirror(0.9, 0.5);
    Light sun = lightOf(LightKind::directional, {}, {0.3, 0.4, -1});
    s.metallic = 0;
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    EXPECT_NEAR(shaded(s, std::span(&sun, 1), 0).reflected.diffuse.g,
                Brdf(s, compensationOf(s, Multiscatter::energy))(-sun.direction).diffuse.g, 1e-3);
    // A sun, and a disc with the same solid angle.
    s.metallic = 1;
    s.albedo = {0.9, 0.6, 0.2};
    Light disc = lightOf(LightKind::disc, sun.direction * -10.0, sun.direction);
    disc.radius = 0.1f;
    disc.intensity = static_cast<float>(100 / (pi * 0.01));
    Random random(7);
    constexpr int walks = 40'000;
    const Between paths(s);
    glm::dvec3 expected = Brdf(s)(-sun.direction).specular;
    for (int i = 0; i < walks; ++i) expected += again(paths, -sun.direction, random) / double{walks};
    for (const Light& light : {sun, disc}) {
        const Shading shading = shaded(s, std::span(&light, 1), 0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(shading.reflected.specular[c], expected[c], 0.015 * expected.r) << c;
    }
}

// Difference of `compensation` from the random walk under ambient light. energy: reflected light, mean
// over cosine-weighted views. shape: half the integrated absolute difference over light directions,
// relative to the walk, for a view at 45 degrees. It measures light from wrong directions.
struct Distance {
    double energy, shape;
};

constexpr int bin_rings = 6, bin_sectors = 6;
using Bins = std::array<double, std::size_t{bin_rings} * bin_sectors>;
std::size_t binOf(const glm::dvec3& l) {
    const int ring = std::min(static_cast<int>(l.z * l.z * bin_rings), bin_rings - 1);
    const double around = std::abs(std::atan2(l.y, l.x)) / pi;
    return static_cast<std::size_t>(ring * bin_sectors +
                                    std::min(static_cast<int>(around * bin_sectors), bin_sectors - 1));
}

Distance distanceOf(Multiscatter compensation, double roughness, double f0, int walks) {
    Random random(6);
    double energy = 0;
    for (int i = 0; i < walks; ++i)
        energy -= walk(roughness, towards(std::sqrt(1 - random())), random, f0).weight / walks;
    constexpr int sights = 24;
    for (int i = 0; i < sights; ++i) {
        const Surface s = metal(roughness, std::sqrt((i + 0.5) / sights), f0);
        energy += specularAlbedo(s, compensationOf(s, compensation)).g / sights;
    }
    const double aside = std::sqrt(0.5);
    Bins truth{}, mine{};
    double all = 0;
    for (int i = 0; i < walks; ++i) {
        const Walk path = walk(roughness, towards(aside), random, f0);
        truth[binOf(path.direction)] += path.weight / walks;
        all += path.weight / walks;
    }
    const Surface s = metal(roughness, aside, f0);
    const Brdf brdf(s, compensationOf(s, compensation));
    constexpr int across = 200;
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
            const double square = (i + 0.5) / across;
            const glm::dvec3 l = towards(std::sqrt(square), pi * (j + 0.5) / across);
            mine[binOf(l)] += brdf(l).specular.g * pi / (l.z * across * across);
        }
    double apart = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) apart += std::abs(mine[i] - truth[i]);
    return {energy, apart / (2 * all)};
}

// Rows of the table in shared/environment/MEASURED.md, which uses a hundred times as many walks. With 36
// bins these walks alone differ by some 0.015 in shape. Both compensations are far closer than none; the
// Lambertian lobe has the better shape.
TEST(ReferenceMicrosurface, HowFarTheCompensationsAre) {
    struct Row {
        double f0, roughness;
        Distance off, energy, fdez;
    };
    constexpr Row rows[] = {{0.9, 0.6, {-0.161, 0.094}, {-0.001, 0.051}, {-0.004, 0.023}},
                            {0.9, 1, {-0.455, 0.293}, {0.024, 0.084}, {-0.038, 0.048}},
                            {0.5, 0.8, {-0.096, 0.127}, {0.004, 0.035}, {-0.017, 0.026}}};
    constexpr int walks = 40'000;
    for (const Row& row : rows)
        for (const auto& [compensation, expected] :
             {std::pair(Multiscatter::off, row.off), std::pair(Multiscatter::energy, row.energy),
              std::pair(Multiscatter::fdez, row.fdez)}) {
            const Distance d = distanceOf(compensation, row.roughness, row.f0, walks);
            EXPECT_NEAR(d.energy, expected.energy, 0.008) << row.f0 << " " << row.roughness;
            EXPECT_NEAR(d.shape, expected.shape, 0.015) << row.f0 << " " << row.roughness;
        }
}

}  // namespace
}  // namespace diptych::reference
