// SPDX-License-Identifier: MIT
// Assignment per_object: ranking, fading and importance, compared with their definitions.
#include "tests/support/object_lights_builder.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

namespace diptych {
namespace {

// ---- brightness --------------------------------------------------------------------------------------

TEST(PerObject, BrightnessIsTheLuminanceOfIrradianceFarAway) {
    Light light = point({0, 0, 200}, 8);
    light.color = {1, 0.5f, 0.25f};
    const double expected = 8 * (0.2126 + 0.7152 / 2 + 0.0722 / 4) / (200.0 * 200.0);
    EXPECT_NEAR(brightnessAt(fromEye({light}), 0, unitBox), expected, 0.01 * expected)
        << "the box is a point there";
    EXPECT_NEAR(brightnessAt(fromEye({sun(3)}), 0, unitBox), 3, 1e-6);
    EXPECT_TRUE(std::isfinite(brightnessAt(fromEye({point({0, 0, 0}, 8)}), 0, unitBox))) << "inside the box";
}

// A long box is lit if the light is close to any part of it, not only to the centre.
TEST(PerObject, BrightnessIsThatOfTheNearestPlace) {
    const ObjectPosition plank{{0, 0, 0}, {10, 0.1, 0.1}};
    const GpuLights lights = fromEye({point({10, 1, 0}, 1, 2)});
    EXPECT_GT(brightnessAt(lights, 0, plank), 0) << "10 m from the centre, beyond its range";
}

// The light is 2 m away and has a range of 2.5 m. The spot's axis misses the object by 0.4 rad, so that the
// object is between its cones.
TEST(PerObject, BrightnessAndHarmonicsHaveTheFalloff) {
    const ObjectPosition dot{{0, 0, 0}, glm::dvec3(1e-6)};
    Light lamp = point({0, 0, 2}, 3, 2.5f), spot = lamp;
    spot.kind = LightKind::spot;
    spot.direction = {std::sin(0.4), 0, -std::cos(0.4)};
    spot.inner_cone = 0.2f;
    spot.outer_cone = 0.6f;
    const double w = 1 - std::pow(2 / 2.5, 4),
                 t = (std::cos(0.4) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
    for (const LightFalloff& falloff : falloffs)
        for (const Light& light : {lamp, spot}) {
            const GpuLights lights = fromEye({light}, falloff);
            double irradiance = 3.0 / 4 * (falloff.squared_window ? w * w : w);
            if (light.kind == LightKind::spot)
                irradiance *= falloff.smooth_cones ? t * t * (3 - 2 * t) : t * t;
            gpu::ObjectIrradiance sum{};
            addHarmonics(sum, lights, 0, dot, 1);
            // Float32 in the spot's cone; brightness widens the box and the cone by 1e-5.
            EXPECT_NEAR(evaluated(sum, {0, 0, 1}), irradiance * (1.0 / 4 + 1.0 / 2 + 5.0 / 16), 1e-5);
            EXPECT_NEAR(brightnessAt(lights, 0, dot), irradiance, 1e-3 * irradiance);
        }
}

// No light that reaches any point of a box, by the shaders' formula, is omitted, and nowhere in the box are
// its window and cone larger than in its brightness.
TEST(PerObject, NoLightThatReachesIsDark) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vec = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
    std::size_t lit = 0, dark = 0;
    for (int round = 0; round < 4000; ++round) {
        const ObjectPosition box{20.0 * vec(), glm::abs(vec()) * std::pow(10.0, 2 * unit(random))};
        Light light = point(20.0 * vec(), 1, static_cast<float>(std::pow(10.0, 1 + unit(random))));
        if (round % 2) {
            light.kind = LightKind::spot;
            light.direction = glm::normalize(vec());
            light.outer_cone = static_cast<float>(0.01 + 1.5 * std::abs(unit(random)));
            light.inner_cone = light.outer_cone / 2;
        }
        const LightFalloff& falloff = falloffs[round / 2 % std::size(falloffs)];
        const GpuLights lights = fromEye({light}, falloff);
        const double brightness = brightnessAt(lights, 0, box),
                     endless = brightnessAt(fromEye({point(light.position, 1)}), 0, box);
        const bool found = brightness > 0;
        bool reached = false;
        for (int i = 0; i < 50; ++i) {
            const glm::vec3 location(box.centre +
                                     box.half * glm::sign(vec()) * (i % 2 ? glm::dvec3(1) : glm::abs(vec())));
            const glm::vec3 to_light = lights.lights[0].position - location;
            const float d2 = glm::dot(to_light, to_light), x = d2 * lights.lights[0].inverse_range_squared;
            bool here = x < 1;
            double fraction = here ? std::pow(1 - double{x} * double{x}, falloff.squared_window ? 2 : 1) : 0;
            if (light.kind == LightKind::spot) {
                const gpu::SpotCone& cone = lights.spot_cones[0];
                const float c = cone.offset - glm::dot(to_light / std::sqrt(d2), cone.direction) * cone.scale;
                here &= c > 0;
                const double t = std::clamp(double{c}, 0.0, 1.0);
                fraction *= falloff.smooth_cones ? t * t * (3 - 2 * t) : t * t;
            }
            reached |= here;
            EXPECT_GE(brightness, endless * fraction) << round;
        }
        EXPECT_TRUE(found || !reached) << round;
        (found ? lit : dark) += 1;
    }
    EXPECT_GT(lit, 500u);
    EXPECT_GT(dark, 500u) << "and not everything counts as lit";
}

// ---- shares ------------------------------------------------------------------------------------------

TEST(PerObject, FadesFromTheThresholdUp) {
    EXPECT_EQ(fade(1, 0), 1) << "nobody is left out";
    EXPECT_EQ(fade(1, 1), 0);
    EXPECT_EQ(fade(0.5, 1), 0);
    EXPECT_EQ(fade(fadeRange, 1), 1);
    double last = 0;
    for (double b = 1; b < 5; b += 0.01) {
        EXPECT_GE(fade(b, 1), last);
        EXPECT_LE(fade(b, 1) - last, 0.012);
        last = fade(b, 1);
    }
}

std::vector<Light> row(std::size_t count) {
    std::vector<Light> lights;
    for (std::size_t i = 0; i < count; ++i)
        lights.push_back(
            point({0, 0, 3.0 + 0.1 * static_cast<double>(i)}, std::ldexp(1024.0f, -2 * static_cast<int>(i))));
    return lights;
}

TEST(PerObject, TheBrightestArePerPixelTheNextPerVertexTheRestHarmonics) {
    // Each light is four times fainter than the previous one and further away, so the groups have whole
    // lights.
    const std::vector<LightFractions> fractions = lightFractions(fromEye(row(12)), unitBox, 3);
    for (std::size_t i = 0; i < fractions.size(); ++i) {
        EXPECT_NEAR(fractions[i].pixel + fractions[i].vertex + fractions[i].harmonics, 1, 1e-15);
        EXPECT_EQ(fractions[i].pixel, i < 3 ? 1 : 0) << i;
        EXPECT_EQ(fractions[i].vertex, i >= 3 && i < 7 ? 1 : 0) << i;
    }
}

TEST(PerObject, WithRoomForAllEachIsWholeAndInOrder) {
    std::vector<Light> lights = row(9);
    lights.push_back(sun(1));
    Light spot = point({0, 2, 3}, 5);
    spot.kind = LightKind::spot;
    lights.insert(lights.begin(), spot);
    spot.direction = {0, -0.6, -0.8};
    lights[0] = spot;
    const GpuLights all = fromEye(lights);
    for (const std::uint32_t pixels : {static_cast<std::uint32_t>(all.count()), 1u << 30}) {
        const ObjectLightLists lists = objectLightLists(all, std::span(&unitBox, 1), pixels);
        EXPECT_EQ(lists.features, gpu::OBJECT_LIGHTS_LISTS) << "nothing per vertex, no harmonics";
        ASSERT_EQ(lists.entries.size(), all.count());
        for (std::size_t i = 0; i < lists.entries.size(); ++i) {
            EXPECT_EQ(lists.entries[i].light, i);
            EXPECT_EQ(lists.entries[i].weight, 1.0f);
        }
        EXPECT_EQ(lists.objects[0].local_begin, 1u);
        EXPECT_EQ(lists.objects[0].point_end, 10u);
        EXPECT_EQ(lists.objects[0].spot_end, 11u);
        EXPECT_EQ(lists.objects[0].area_end, 11u);
        EXPECT_EQ(lists.objects[0].vertex_end, 11u);
        EXPECT_EQ(lists.longest, 10u);
    }
}

TEST(PerObject, NeverMoreThanThereIsRoomFor) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int round = 0; round < 200; ++round) {
        std::vector<Light> lights;
        for (int i = 0; i < 30; ++i)
            lights.push_back(point({9 * unit(random), 9 * unit(random), 9 * unit(random)}, 1));
        for (const std::uint32_t pixels : {0u, 1u, 4u, 8u}) {
            std::size_t perPixel = 0, beyond = 0;
            for (const LightFractions& s : lightFractions(fromEye(lights), unitBox, pixels)) {
                perPixel += s.pixel > 0;
                beyond += s.pixel == 0 && s.vertex > 0;
                EXPECT_GE(s.vertex, 0);
                EXPECT_GE(s.harmonics, 0);
            }
            EXPECT_LE(perPixel, pixels);
            EXPECT_LE(beyond, 4u);
        }
    }
}

// One of the lights moves past the others, into its range and out of it, in steps of 1 cm: no fraction jumps.
// At most 0.05: a step changes the closest light's brightness by up to 3 %, and the fade's steepest slope
// is 1.5 over ln 4.
TEST(PerObject, NothingPopsAsALightMoves) {
    std::vector<LightFractions> before;
    std::vector<double> dark;
    double largest = 0, moved = 0;
    for (int step = 0; step <= 1600; ++step) {
        std::vector<Light> lights{point({-8 + 0.01 * step, 1.5, 0}, 3, 5)};
        for (int i = 0; i < 12; ++i)
            lights.push_back(
                point({std::cos(i) * (2 + 0.2 * i), std::sin(i), 2}, 1.0f + 0.2f * static_cast<float>(i), 6));
        Light strongest = sun(0.2f);
        lights.push_back(strongest);
        const GpuLights all = fromEye(lights);
        const std::vector<LightFractions> fractions = lightFractions(all, unitBox, 3);
        for (std::size_t i = 0; i < before.size(); ++i) {
            const double brightness = brightnessAt(all, i, unitBox);
            // Very faint lights may change their group: at the end of its range a light contributes
            // nothing.
            if (brightness < 1e-3) continue;
            for (const auto fraction :
                 {&LightFractions::pixel, &LightFractions::vertex, &LightFractions::harmonics}) {
                largest = std::max(largest, std::abs(fractions[i].*fraction - before[i].*fraction));
                moved = std::max(
                    moved, std::abs(fractions[i].*fraction - lightFractions(all, unitBox, 12)[i].*fraction));
            }
        }
        before = fractions;
    }
    EXPECT_LE(largest, 0.05);
    EXPECT_GT(moved, 0.5) << "lights do change their group";
}

TEST(PerObject, ImportanceOverridesTheRanking) {
    std::vector<Light> lights = row(12);
    lights[0].importance = Importance::not_important;
    lights[11].importance = Importance::important;
    const std::vector<LightFractions> fractions = lightFractions(fromEye(lights), unitBox, 2);
    EXPECT_EQ(fractions[0].pixel, 0) << "the brightest";
    EXPECT_EQ(fractions[0].vertex, 1);
    EXPECT_EQ(fractions[11].pixel, 1) << "the faintest";
    EXPECT_EQ(fractions[1].pixel, 1);
    EXPECT_EQ(fractions[2].pixel, 1) << "the important one takes no other light's place";
    EXPECT_EQ(fractions[3].pixel, 0);
    lights[11].range = 1;
    EXPECT_EQ(lightFractions(fromEye(lights), unitBox, 2)[11].pixel, 0) << "but it must reach";
}

// Lights are sorted by type and dark ones are omitted: each must keep its own importance.
TEST(PerObject, ImportanceStaysWithItsLight) {
    Light black = point({0, 0, 3}, 0), spot = point({0, 2, 3}, 1000), panel = point({0, 0, 20}, 0.01f),
          lamp = point({0, 0, 3}, 1000);
    black.importance = Importance::important;
    spot.kind = LightKind::spot;
    spot.direction = {0, -0.6, -0.8};
    spot.importance = Importance::not_important;
    panel.kind = LightKind::disc;
    panel.importance = Importance::important;
    Light faint = sun(1e-6f);
    faint.importance = Importance::important;
    const GpuLights all = fromEye({black, panel, spot, lamp, faint, sun(1)});
    ASSERT_EQ(all.count(), 5u);
    EXPECT_EQ(all.importance,
              (std::vector{Importance::important, Importance::automatic, Importance::automatic,
                           Importance::not_important, Importance::important}))
        << "two suns, the lamp, the spot, the panel";
    const std::vector<LightFractions> fractions = lightFractions(all, unitBox, 1);
    EXPECT_EQ(fractions[0].pixel, 1) << "a faint sun that is important";
    EXPECT_EQ(fractions[1].pixel, 1) << "the base";
    EXPECT_EQ(fractions[2].pixel, 1) << "the one that there is room for";
    EXPECT_EQ(fractions[3].pixel, 0) << "not important, however bright";
    EXPECT_EQ(fractions[3].vertex, 1);
    EXPECT_EQ(fractions[4].pixel, 1) << "an important panel";
    // In the objects' lists, in the order of the lights.
    const ObjectLightLists lists = objectLightLists(all, std::span(&unitBox, 1), 1);
    std::vector<gpu::uint> perPixel;
    for (gpu::uint i = lists.objects[0].begin; i < lists.objects[0].area_end; ++i)
        perPixel.push_back(lists.entries[i].light);
    EXPECT_EQ(perPixel, (std::vector<gpu::uint>{0, 1, 2, 4}));
}

// For any importances and any number of lights per pixel: important lights are fully per pixel wherever
// they reach, unimportant ones never. The others behave as without important ones.
TEST(PerObject, ImportanceHoldsForAnyLights) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int round = 0; round < 200; ++round) {
        std::vector<Light> lights, unmarked;
        for (int i = 0; i < 24; ++i) {
            Light light = point({9 * unit(random), 9 * unit(random), 9 * unit(random)},
                                std::exp2(static_cast<float>(6 * unit(random))), 12);
            light.importance = i % 4 == 0   ? Importance::important
                               : i % 4 == 1 ? Importance::not_important
                                            : Importance::automatic;
            lights.push_back(light);
            if (light.importance != Importance::important) unmarked.push_back(light);
        }
        for (const std::uint32_t pixels : {0u, 1u, 4u, 24u}) {
            const GpuLights all = fromEye(lights);
            const std::vector<LightFractions> fractions = lightFractions(all, unitBox, pixels),
                                              without = lightFractions(fromEye(unmarked), unitBox, pixels);
            for (std::size_t i = 0, other = 0; i < lights.size(); ++i) {
                const bool reaches = brightnessAt(all, i, unitBox) > 0;
                if (lights[i].importance == Importance::important) {
                    EXPECT_EQ(fractions[i].pixel, reaches ? 1 : 0);
                    continue;
                }
                if (lights[i].importance == Importance::not_important) {
                    EXPECT_EQ(fractions[i].pixel, 0);
                }
                EXPECT_EQ(fractions[i].pixel, without[other].pixel);
                EXPECT_EQ(fractions[i].vertex, without[other].vertex);
                EXPECT_EQ(fractions[i].harmonics, without[other++].harmonics);
            }
        }
    }
}

// An area light is ranked like any other light, but never per vertex. In harmonics it is as bright as a
// small light of its intensity.
TEST(PerObject, AreaLightsArePerPixelOrHarmonics) {
    Light panel = point({0, 0, 20}, 5);
    panel.kind = LightKind::rect;
    panel.width = 0.2f;
    panel.height = 0.3f;
    std::vector<Light> lights = row(3);
    lights.push_back(panel);
    const GpuLights all = fromEye(lights);
    EXPECT_EQ(lightFractions(all, unitBox, 4)[3].pixel, 1);
    const LightFractions faint = lightFractions(all, unitBox, 1)[3];
    EXPECT_EQ(faint.pixel, 0);
    EXPECT_EQ(faint.vertex, 0);
    EXPECT_EQ(faint.harmonics, 1);
    gpu::ObjectIrradiance of_panel{}, of_point{};
    addHarmonics(of_panel, all, 3, unitBox, 1);
    addHarmonics(of_point, fromEye({point({0, 0, 20}, 5 * 0.2f * 0.3f)}), 0, unitBox, 1);
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 n(std::sin(i), 0, std::cos(i));
        EXPECT_NEAR(evaluated(of_panel, n), evaluated(of_point, n), 1e-9);
    }
    const ObjectPosition places[] = {unitBox};
    EXPECT_EQ(objectLightLists(all, places, 10).objects[0].area_end, 4u);
}

TEST(PerObject, TheBaseIsTheBrightestDirectionalLight) {
    std::vector<Light> lights = row(6);
    lights.push_back(sun(1e-3f));
    lights.push_back(sun(1e-5f));
    const std::vector<LightFractions> fractions = lightFractions(fromEye(lights), unitBox, 0);
    EXPECT_EQ(fractions[0].pixel, 1) << "directional lights come first";
    EXPECT_EQ(fractions[1].pixel, 0);
    for (std::size_t i = 2; i < 8; ++i) EXPECT_EQ(fractions[i].pixel, 0);
    lights[6].importance = Importance::not_important;
    EXPECT_EQ(lightFractions(fromEye(lights), unitBox, 0)[0].pixel, 0);
    EXPECT_EQ(lightFractions(fromEye(lights), unitBox, 0)[1].pixel, 1) << "then the next one is the base";
    // A shadow-casting sun is the base whatever its importance, and no other sun is a base beside it.
    GpuLights casting = fromEye(lights);
    casting.base = 0;
    EXPECT_EQ(lightFractions(casting, unitBox, 0)[0].pixel, 1);
    EXPECT_EQ(lightFractions(casting, unitBox, 0)[1].pixel, 0);
}

// The base has no fraction per vertex or in harmonics, even beside equally bright suns.
TEST(PerObject, TheBaseIsWholeBesideSunsAsBright) {
    for (const float second : {1.0f, 0.999f, 0.5f})
        for (const std::uint32_t pixels : {0u, 1u, 3u}) {
            std::vector<Light> lights = row(6);  // brighter
            lights.push_back(sun(second));
            lights.push_back(sun(1));
            const GpuLights all = fromEye(lights);
            const std::size_t base = second < 1 ? 1 : 0;
            EXPECT_EQ(all.base, base) << second;
            const std::vector<LightFractions> fractions = lightFractions(all, unitBox, pixels);
            EXPECT_EQ(fractions[base].pixel, 1) << second << " " << pixels;
            EXPECT_EQ(fractions[1 - base].pixel, 0) << "the next has no place of its own";
        }
}

// Among equal lights a group takes as many as it has capacity for, the scene's first ones.
TEST(PerObject, EqualLightsAreRankedByTheScenesOrder) {
    std::vector<Light> suns(64, sun(2)), lamps(64, point({0, 3, 4}, 5));
    for (const std::vector<Light>& lights : {suns, lamps})
        for (const std::uint32_t pixels : {1u, 4u, 9u}) {
            const std::vector<LightFractions> fractions = lightFractions(fromEye(lights), unitBox, pixels);
            for (std::size_t i = 0; i < fractions.size(); ++i) {
                EXPECT_EQ(fractions[i].pixel, i < pixels ? 1 : 0) << i;
                EXPECT_EQ(fractions[i].vertex, i >= pixels && i < pixels + 4 ? 1 : 0) << i;
                EXPECT_EQ(fractions[i].harmonics, i >= pixels + 4 ? 1 : 0) << i;
            }
        }
    // A spot light before equally bright point lights: types are sorted, ranks are not.
    std::vector<Light> mixed(3, point({0, 0, 3}, 4));
    mixed.insert(mixed.begin(), mixed[0]);
    mixed[0].kind = LightKind::spot;
    mixed[0].direction = {0, 0, -1};
    mixed[0].outer_cone = 1.5f;
    mixed[0].inner_cone = 1.4f;
    const GpuLights all = fromEye(mixed);
    ASSERT_EQ(all.sources, (std::vector<std::size_t>{1, 2, 3, 0}));
    ASSERT_EQ(brightnessAt(all, 0, unitBox), brightnessAt(all, 3, unitBox));
    const std::vector<LightFractions> fractions = lightFractions(all, unitBox, 2);
    EXPECT_EQ(fractions[3].pixel, 1);
    EXPECT_EQ(fractions[0].pixel, 1);
    EXPECT_EQ(fractions[1].pixel, 0);
    EXPECT_EQ(fractions[2].pixel, 0);
}

// A light that becomes brighter than several equal ones replaces the last of them gradually.
TEST(PerObject, EqualLightsMakeRoomWithoutAPop) {
    std::vector<LightFractions> before;
    double largest = 0, min = 1;
    for (double candela = 0.5; candela < 12; candela *= 1.003) {
        std::vector<Light> lights(8, sun(1));
        lights.push_back(point({0, 0, 2}, static_cast<float>(candela)));
        const GpuLights all = fromEye(lights);
        const std::vector<LightFractions> fractions = lightFractions(all, unitBox, 3);
        double sum = 0;
        for (std::size_t i = 0; i < fractions.size(); ++i) {
            sum += fractions[i].pixel;
            if (before.empty()) continue;
            for (const auto fraction :
                 {&LightFractions::pixel, &LightFractions::vertex, &LightFractions::harmonics})
                largest = std::max(largest, std::abs(fractions[i].*fraction - before[i].*fraction));
        }
        EXPECT_NEAR(sum, 3, 1e-12) << candela;
        EXPECT_EQ(fractions[1].pixel, 1);
        min = std::min(min, fractions[2].pixel);
        before = fractions;
    }
    EXPECT_LT(largest, 0.01);
    EXPECT_LT(min, 0.01) << "in the end the third sun has none";
}

TEST(PerObject, AnObjectWithALightmapHasNoHarmonics) {
    ObjectPosition baked = unitBox;
    baked.harmonics = false;
    const ObjectPosition places[] = {unitBox, baked};
    const ObjectLightLists lists = objectLightLists(fromEye(row(12)), places, 1);
    EXPECT_EQ(lists.features, gpu::OBJECT_LIGHTS_LISTS | gpu::OBJECT_LIGHTS_VERTEX | gpu::OBJECT_LIGHTS_SH);
    EXPECT_GT(lists.objects[0].irradiance.constant.g, 0);
    EXPECT_EQ(lists.objects[1].irradiance.constant, glm::vec3(0));
    EXPECT_EQ(lists.objects[1].spot_end - lists.objects[1].begin,
              lists.objects[0].spot_end - lists.objects[0].begin);
}

}  // namespace
}  // namespace diptych
