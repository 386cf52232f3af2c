// SPDX-License-Identifier: MIT
// Spherical harmonics of assignment per_object, compared with numeric integration. Also: every light is in
// one of the three groups, and none jumps from one to another.
#include "tests/support/object_lights_builder.h"

#include <algorithm>
#include <functional>
#include <random>
#include <utility>

namespace diptych {
namespace {

glm::dvec3 direction(double cosine, double phi) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// The nine real harmonics (Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks", appendix A2).
std::array<double, 9> harmonics(const glm::dvec3& n) {
    const double a = std::sqrt(1 / (4 * pi)), b = std::sqrt(3 / (4 * pi)), c = std::sqrt(15 / (4 * pi));
    return {a,
            b * n.y,
            b * n.z,
            b * n.x,
            c * n.x * n.y,
            c * n.y * n.z,
            std::sqrt(5 / (16 * pi)) * (3 * n.z * n.z - 1),
            c * n.x * n.z,
            c / 2 * (n.x * n.x - n.y * n.y)};
}

// Calls `call` with directions distributed over the sphere and the solid angle of each.
void overSphere(int rings, const std::function<void(const glm::dvec3&, double)>& call) {
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < rings; ++j)
            call(direction(-1 + 2 * (i + 0.5) / rings, 2 * pi * (j + 0.5) / rings), 4 * pi / (rings * rings));
}

using Coefficients = std::array<glm::dvec3, 9>;
Coefficients projected(const std::function<glm::dvec3(const glm::dvec3&)>& f, int rings) {
    Coefficients result{};
    overSphere(rings, [&](const glm::dvec3& n, double area) {
        const glm::dvec3 value = f(n) * area;
        const std::array<double, 9> basis = harmonics(n);
        for (std::size_t k = 0; k < 9; ++k) result[k] += value * basis[k];
    });
    return result;
}
glm::dvec3 evaluatedAt(const Coefficients& coefficients, const glm::dvec3& n) {
    glm::dvec3 sum(0);
    for (std::size_t k = 0; k < 9; ++k) sum += coefficients[k] * harmonics(n)[k];
    return sum;
}

// The clamped cosine around a light, projected on the nine harmonics by quadrature and evaluated again.
TEST(PerObject, HarmonicsAreTheProjectionOfTheClampedCosine) {
    for (const glm::dvec3 to_light : {direction(1, 0), direction(-0.3, 1), direction(0.5, 4)}) {
        const Coefficients cosine = projected(
            [&](const glm::dvec3& n) { return glm::dvec3(std::max(glm::dot(n, to_light), 0.0)); }, 400);
        gpu::ObjectIrradiance sum{};
        addHarmonics(sum, {1, 2, 3}, to_light);
        for (int i = 0; i < 40; ++i) {
            const glm::dvec3 n = direction(std::cos(0.1 * i), 2.3 * i);
            EXPECT_NEAR(glm::length(evaluatedRgb(sum, n) - glm::dvec3(1, 2, 3) * evaluatedAt(cosine, n)), 0,
                        2e-4);
            // Three bands of the cosine are off by up to 3/32, directly behind by 1/16 (Ramamoorthi and
            // Hanrahan 2001).
            EXPECT_NEAR(evaluated(sum, n) / 2, std::max(glm::dot(n, to_light), 0.0), 3.0 / 32 + 1e-6);
        }
    }
}

// Inside the bounding sphere light comes from many sides, at the centre from all. This gives the clamped
// cosine's mean over the sphere, 1/4.
TEST(PerObject, ALightInTheCentreShinesOnAllSidesAlike) {
    const double radius2 = 0.75;
    for (const double distance : {0.0, 1e-9}) {
        const GpuLights lights = fromEye({point({0, 0, distance}, 2)});
        gpu::ObjectIrradiance sum{};
        addHarmonics(sum, lights, 0, unitBox, 0.5);
        for (int i = 0; i < 20; ++i)
            EXPECT_NEAR(evaluated(sum, direction(std::cos(i), i)), 2 * 0.5 / radius2 / 4, 1e-5);
    }
    // From outside it acts as a light with the irradiance at the centre.
    const GpuLights far = fromEye({point({0, 0, 10}, 2)});
    gpu::ObjectIrradiance sum{}, same{};
    addHarmonics(sum, far, 0, unitBox, 1);
    addHarmonics(same, glm::dvec3(0.02), {0, 0, 1});
    for (int i = 0; i < 20; ++i)
        EXPECT_NEAR(evaluated(sum, direction(std::cos(i), i)), evaluated(same, direction(std::cos(i), i)),
                    1e-8);
}

// A light from more than one side is a Henyey-Greenstein lobe (1941, "Diffuse radiation in the Galaxy").
// Its mean cosine is `directed`, and its bands are the powers of that. The test integrates the lobe's
// radiance over the sphere, then over each normal's hemisphere by the cosine's bands, also integrated
// numerically.
TEST(PerObject, ADirectedLightIsALobeOfThatMeanCosine) {
    const std::array<std::function<double(double)>, 3> legendre{
        [](double) { return 1.0; }, [](double c) { return c; }, [](double c) { return (3 * c * c - 1) / 2; }};
    std::array<double, 3> cosine{};  // 2 pi times the integral of max(c, 0) P(c)
    constexpr int steps = 20000;
    for (std::size_t l = 0; l < 3; ++l)
        for (int i = 0; i < steps; ++i) {
            const double c = (i + 0.5) / steps;
            cosine[l] += 2 * pi * c * legendre[l](c) / steps;
        }
    const glm::dvec3 to_light = direction(0.4, 2), e(0.5, 1, 2);
    for (const double g : {0.0, 0.25, 0.6, 0.8}) {
        const Coefficients radiance = projected(
            [&](const glm::dvec3& w) {
                const double d = 1 + g * g - 2 * g * glm::dot(w, to_light);
                return e * ((1 - g * g) / (4 * pi * d * std::sqrt(d)));
            },
            500);
        Coefficients irradiance = radiance;
        for (std::size_t k = 0; k < 9; ++k) irradiance[k] *= cosine[k == 0 ? 0 : k < 4 ? 1 : 2];
        gpu::ObjectIrradiance sum{};
        addHarmonics(sum, e, to_light, g);
        for (int i = 0; i < 40; ++i) {
            const glm::dvec3 n = direction(std::cos(0.1 * i), 2.3 * i);
            EXPECT_NEAR(glm::length(evaluatedRgb(sum, n) - evaluatedAt(irradiance, n)), 0, 1e-4) << g;
        }
    }
}

// ---- all groups together -----------------------------------------------------------------------------

// Lights of all types around a small box. No light is far brighter than the next in rank, so some have
// fractions in two groups.
std::vector<Light> mixedLights(unsigned seed, std::size_t count, double closest) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vec = [&] { return glm::normalize(glm::dvec3(unit(random), unit(random), unit(random))); };
    std::vector<Light> lights;
    for (std::size_t i = 0; i < count; ++i) {
        const double distance = closest * std::exp2(1.5 * std::abs(unit(random)));
        Light light = point(distance * vec(), static_cast<float>(10 * std::exp2(unit(random))),
                            static_cast<float>(distance * (i % 7 == 6 ? 0.5 : 1.5)));
        light.color = glm::vec3(0.6f) + 0.4f * glm::abs(glm::vec3(vec()));
        light.direction = -glm::normalize(glm::normalize(light.position) + 0.3 * vec());
        switch (i % 6) {
            case 1:
                light.kind = LightKind::spot;
                light.outer_cone = 1;
                light.inner_cone = 0.2f;
                break;
            case 3:
                light.kind = LightKind::directional;
                light.intensity *= static_cast<float>(1 / (closest * closest));
                break;
            case 4:
                light.kind = i % 12 == 4 ? LightKind::rect : LightKind::disc;
                light.width = 0.3f;
                light.height = 0.2f;
                light.radius = 0.15f;
                light.axis = glm::normalize(glm::cross(light.direction, glm::dvec3(0.3, 1, 0.2)));
                light.intensity *= 15;
                break;
            default:
                break;
        }
        light.importance = i % 11 == 5   ? Importance::important
                           : i % 11 == 9 ? Importance::not_important
                                         : Importance::automatic;
        lights.push_back(light);
    }
    return lights;
}

// Unit direction to a light and its irradiance at the origin, W/m^2 per colour, by the shaders' formulas.
// It is zero beyond the range. An area light's is its radiance times the solid angle of a small patch.
struct Arriving {
    glm::dvec3 to_light, irradiance;
};
Arriving arriving(const GpuLights& all, std::size_t i) {
    const gpu::Light& light = all.lights[i];
    if (i < all.directional) return {glm::dvec3(light.position), glm::dvec3(light.intensity)};
    const double squared = glm::dot(glm::dvec3(light.position), glm::dvec3(light.position));
    const glm::dvec3 l = glm::dvec3(light.position) / std::sqrt(squared);
    const double x = squared * double{light.inverse_range_squared};
    const double window = std::max(0.0, 1 - x * x);
    double scale = (all.falloff.squared_window ? window * window : window) / squared;
    const std::size_t spots = all.directional + all.point, areas = spots + all.spot;
    if (i >= spots && i < areas) {
        const gpu::SpotCone& cone = all.spot_cones[i - spots];
        const double c = std::clamp(
            double{cone.offset} - glm::dot(l, glm::dvec3(cone.direction)) * double{cone.scale}, 0.0, 1.0);
        scale *= all.falloff.smooth_cones ? c * c * (3 - 2 * c) : c * c;
    }
    if (i >= areas) {
        const gpu::AreaLight& area = all.area_lights[i - areas];
        const double patch = i < areas + all.areas[0] ? 0.3 * 0.2 : pi * 0.15 * 0.15;
        scale *= patch * std::max(0.0, -glm::dot(l, glm::dvec3(area.direction)));
    }
    return {l, glm::dvec3(light.intensity) * scale};
}

// Every light's fractions in the groups add up to one.
TEST(PerObject, TheGroupsShareEachLight) {
    std::size_t broken = 0, dark = 0;
    for (unsigned round = 0; round < 60; ++round) {
        const GpuLights all = fromEye(mixedLights(round, 30, 6));
        for (const std::uint32_t pixels : {0u, 2u, 4u, 8u, 40u}) {
            const std::vector<LightFractions> fractions = lightFractions(all, unitBox, pixels);
            const ObjectLightLists lists = objectLightLists(all, std::span(&unitBox, 1), pixels);
            const gpu::ObjectLights& object = lists.objects[0];
            ASSERT_EQ(fractions.size(), all.count());
            std::vector<double> listed(all.count());
            for (gpu::uint i = object.begin; i < object.vertex_end; ++i) {
                const gpu::ObjectLight& entry = lists.entries[i];
                const LightFractions& s = fractions[entry.light];
                EXPECT_EQ(entry.weight, static_cast<float>(i < object.area_end ? s.pixel : s.vertex));
                listed[entry.light] += double{entry.weight};
            }
            for (std::size_t i = 0; i < all.count(); ++i) {
                const LightFractions& s = fractions[i];
                for (const double fraction : {s.pixel, s.vertex, s.harmonics}) {
                    EXPECT_GE(fraction, 0);
                    EXPECT_LE(fraction, 1);
                    broken += fraction > 0 && fraction < 1;
                }
                const bool reaches = brightnessAt(all, i, unitBox) > 0;
                dark += !reaches;
                EXPECT_NEAR(s.pixel + s.vertex + s.harmonics, reaches ? 1 : 0, 1e-12);
                EXPECT_NEAR(listed[i] + s.harmonics, reaches ? 1 : 0, 1e-6);
            }
        }
    }
    EXPECT_GT(broken, 1000u);
    EXPECT_GT(dark, 100u);
}

// An object's harmonics are the projection of the remaining lights' irradiance, weighted by their fractions.
// With the other groups' lights they give the irradiance of all lights, within the error of three bands.
TEST(PerObject, TheRestIsTheProjectionOfItsIrradiance) {
    const ObjectPosition box{{0, 0, 0},
                             {0.2, 0.1, 0.3}};  // smaller than all distances here, so no light is softened
    for (const auto& [pixels, falloff] :
         {std::pair(0u, LightFalloff{}), {3u, LightFalloff{}}, {0u, LightFalloff{true, true}}}) {
        const GpuLights all = fromEye(mixedLights(17, 30, 4), falloff);
        const std::vector<LightFractions> fractions = lightFractions(all, box, pixels);
        const ObjectLightLists lists = objectLightLists(all, std::span(&box, 1), pixels);
        const gpu::ObjectIrradiance& found = lists.objects[0].irradiance;
        double broken = 0;
        for (const LightFractions& s : fractions) broken += s.harmonics > 0 && s.harmonics < 1;
        EXPECT_GE(broken, 2);
        std::vector<Arriving> lights;
        for (std::size_t i = 0; i < all.count(); ++i) lights.push_back(arriving(all, i));
        const auto sumOf = [&](const glm::dvec3& n, const auto& fraction) {
            glm::dvec3 sum(0);
            for (std::size_t i = 0; i < lights.size(); ++i)
                sum += lights[i].irradiance *
                       (fraction(fractions[i]) * std::max(glm::dot(n, lights[i].to_light), 0.0));
            return sum;
        };
        const auto rest = [](const LightFractions& s) { return s.harmonics; };
        const Coefficients expected = projected([&](const glm::dvec3& n) { return sumOf(n, rest); }, 250);
        double all_of_rest = 0;
        for (std::size_t i = 0; i < lights.size(); ++i)
            all_of_rest += fractions[i].harmonics * lights[i].irradiance.g;
        ASSERT_GT(all_of_rest, 0.1);
        for (int i = 0; i < 60; ++i) {
            const glm::dvec3 n = direction(std::cos(0.1 * i), 2.3 * i);
            // 3e-4 for 250 x 250 directions and float32.
            EXPECT_NEAR(glm::length(evaluatedRgb(found, n) - evaluatedAt(expected, n)), 0, 3e-4 * all_of_rest)
                << i;
            const double listed = sumOf(n, [](const LightFractions& s) { return s.pixel + s.vertex; }).g;
            const double every =
                sumOf(n, [](const LightFractions& s) { return s.pixel + s.vertex + s.harmonics; }).g;
            EXPECT_NEAR(listed + evaluated(found, n), every, (3.0 / 32 + 1e-4) * all_of_rest);
        }
    }
}

// ---- no popping --------------------------------------------------------------------------------------

// Irradiance of each group at the box's centre for several normals, with the lights' fractions.
std::vector<glm::dvec3> groupsAt(const std::vector<Light>& lights, const ObjectPosition& box) {
    const GpuLights all = gpuLights(lights, box.centre);
    const ObjectPosition here{{0, 0, 0}, box.half};
    const ObjectLightLists lists = objectLightLists(all, std::span(&here, 1), 2);
    const gpu::ObjectLights& object = lists.objects[0];
    std::vector<glm::dvec3> result;
    for (const glm::dvec3 n :
         {direction(1, 0), direction(-1, 0), direction(0.1, 1), direction(-0.2, 3), direction(0.3, 5)}) {
        glm::dvec3 groups(0, 0, evaluated(object.irradiance, n));
        for (gpu::uint i = object.begin; i < object.vertex_end; ++i) {
            const Arriving light = arriving(all, lists.entries[i].light);
            groups[i < object.area_end ? 0 : 1] += double{lists.entries[i].weight} * light.irradiance.g *
                                                   std::max(glm::dot(n, light.to_light), 0.0);
        }
        result.push_back(groups);
    }
    return result;
}

// The largest change of any group between steps of `step` metres, from -8 to 8 m.
double largestStep(const std::function<std::vector<glm::dvec3>(double)>& at, double step) {
    double largest = 0;
    std::vector<glm::dvec3> before;
    for (int i = 0; i <= static_cast<int>(16 / step); ++i) {
        const std::vector<glm::dvec3> now = at(-8 + step * i);
        for (std::size_t n = 0; n < before.size(); ++n)
            for (int group = 0; group < 3; ++group)
                largest = std::max(largest, std::abs(now[n][group] - before[n][group]));
        before = now;
    }
    return largest;
}

// A light passes others and leaves its range, or the object moves. A quarter of the step changes each
// group by about a quarter, whereas a jump does not shrink. 0.35 allows for curvature.
TEST(PerObject, EachGroupIsContinuous) {
    std::vector<Light> lights;
    for (int i = 0; i < 14; ++i)
        lights.push_back(point({4 * std::cos(i), 3 * std::sin(2 * i), 2.5 + 0.2 * i},
                               2.0f + 0.3f * static_cast<float>(i), 7));
    lights.push_back(sun(0.05f));
    lights.push_back(sun(0.02f));
    lights.back().direction = {1, 0, 0};
    Light spot = point({-1, 3, 0}, 12, 8);
    spot.kind = LightKind::spot;
    spot.direction = {0, -1, 0};
    spot.outer_cone = 0.6f;
    spot.inner_cone = 0.1f;
    lights.push_back(spot);
    const auto lightWalks = [&](double x) {
        std::vector<Light> moved = lights;
        moved[0].position = {x, 1.2, 0.3};
        return groupsAt(moved, unitBox);
    };
    const auto objectWalks = [&](double x) {
        ObjectPosition box = unitBox;
        box.centre = {x, 0.2, 0.1};
        return groupsAt(lights, box);
    };
    for (const auto& walk : {std::function<std::vector<glm::dvec3>(double)>(lightWalks), {objectWalks}}) {
        const double coarse = largestStep(walk, 0.02), fine = largestStep(walk, 0.005);
        EXPECT_GT(coarse, 1e-3) << "something changes";
        EXPECT_LT(fine, 0.35 * coarse);
    }
}

}  // namespace
}  // namespace diptych
