// SPDX-License-Identifier: MIT
// Assignment per_object: its error with few lights per pixel, and that lights do not pop.
#include "shared/light/per_object.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/load.h"
#include "shared/scene/view.h"
#include "tests/image/square.h"

#include <glm/common.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>

#include <cstdio>
#include <random>
#include <utility>

namespace diptych::tests {
namespace {

Settings image(Assignment assign, int pixels, Size size = {160, 90}) {
    Settings settings = unshadowed();
    settings.path = Path::forward_plus;
    settings.size = size;
    settings.assign = assign;
    if (assign == Assignment::per_object) settings.pixel_lights = pixels;
    return settings;
}

std::vector<Frame> drawnAll(const Scene& scene, const std::vector<Settings>& settings) {
    return drawAll(scene, settings, untimed({Channel::lit, Channel::light_count, Channel::material_id}));
}

Frame drawn(const Scene& scene, Assignment assign, int pixels, Size size = {160, 90}) {
    return drawnAll(scene, {image(assign, pixels, size)}).front();
}

// With all lights, and with four per pixel.
std::pair<Frame, Frame> bothWays(const Scene& scene) {
    std::vector<Frame> frames =
        drawnAll(scene, {image(Assignment::every, 0), image(Assignment::per_object, 4)});
    return {std::move(frames[0]), std::move(frames[1])};
}

// Mean
// a - b
// divided by the mean of b.
double meanError(const Image& a, const Image& b) {
    double error = 0, sum = 0;
    for (std::size_t i = 0; i < a.data.size(); ++i) {
        error += std::abs(double{a.data[i]} - double{b.data[i]});
        sum += double{b.data[i]};
    }
    return error / sum;
}

TEST(PerObject, FewerLightsPerPixelAreFurtherFromEvery) {
    for (const char* name :
         {"builtin:spheres?lights=64", "builtin:points", "builtin:spots", "builtin:suns"}) {
        const Scene scene = loadScene(name);
        const Image every = drawn(scene, Assignment::every, 0).channels.at(Channel::lit);
        double last = 0;
        for (const int pixels : {8, 4, 2, 0}) {
            const Frame frame = drawn(scene, Assignment::per_object, pixels);
            const double error = meanError(frame.channels.at(Channel::lit), every);
            EXPECT_EQ(frame.counters.nonfinite_pixels, 0u);
            EXPECT_EQ(frame.counters.unreproduced_pixels, 0u);
            EXPECT_GE(error, last * 0.99) << name << " " << pixels;
            EXPECT_LT(error, 0.9) << name << " " << pixels << ": 1 is what no light at all would be off by";
            last = error;
        }
    }
}

TEST(PerObject, AsManyLightsAsAskedForAreShadedPerPixel) {
    const Scene scene = loadScene("builtin:spheres?lights=256");
    for (const int pixels : {1, 4, 8}) {
        const Image counts = drawn(scene, Assignment::per_object, pixels).channels.at(Channel::light_count);
        const float max = *std::ranges::max_element(counts.data);
        EXPECT_LE(max, static_cast<float>(pixels + 1)) << "the sun is the base";
        EXPECT_GE(max, static_cast<float>(pixels));
    }
}

// The largest effect of one step of the scene on the difference between per_object and every, relative to
// local radiance. That is the largest component of `every` at the pixel, at least 1/100 of the image's
// mean: surfaces facing away from all lamps get a little light from harmonics.
double popOf(const Frame& every, const Frame& everyNext, const Frame& object, const Frame& objectNext) {
    const Image &a = every.channels.at(Channel::lit), &b = everyNext.channels.at(Channel::lit),
                &c = object.channels.at(Channel::lit), &d = objectNext.channels.at(Channel::lit);
    double largest = 0, mean = 0;
    for (const float v : a.data) mean += double{v} / static_cast<double>(a.data.size());
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        const double local = std::max(double{*std::max_element(a.pixel(i), a.pixel(i) + 3)}, 0.01 * mean);
        for (int k = 0; k < 3; ++k) {
            const double change = double{b.pixel(i)[k]} - double{a.pixel(i)[k]};
            const double own = double{d.pixel(i)[k]} - double{c.pixel(i)[k]};
            largest = std::max(largest, std::abs(own - change) / local);
        }
    }
    return largest;
}

// Twelve lamps a few metres above nine balls and a tiled floor. One is at (x, height, z); its rank among
// all lights changes with x.
Scene movingLamp(double x, double height = 8.3, double z = -6.32) {
    Scene scene = loadScene("builtin:spheres?lights=0");
    for (int i = 0; i < 12; ++i) {
        Light lamp;
        lamp.position = {12 * std::cos(0.52 * i), 5 + 0.3 * i, 12 * std::sin(0.52 * i)};
        lamp.color = {1, 0.7f + 0.02f * static_cast<float>(i), 0.6f};
        lamp.intensity = 60;
        lamp.range = 40;
        scene.lights.push_back(lamp);
    }
    scene.lights.back().position = {x, height, z};
    return scene;
}

// Within two metres of a surface, radiance itself changes by more than 1 % per centimetre.
TEST(PerObject, NothingPopsAsALightMovesByACentimetre) {
    double worst = 0;
    const glm::dvec2 above[] = {{1.2, 8.3}, {7.2, 8.3}, {16.2, 8.3}}, among[] = {{-9, 2}, {4.5, 2}};
    const auto pop = [&](const Scene& here, const Scene& there) {
        const auto [every, object] = bothWays(here);
        const auto [everyNext, objectNext] = bothWays(there);
        return popOf(every, everyNext, object, objectNext);
    };
    for (const glm::dvec2 at : above) {
        const double largest = pop(movingLamp(at.x, at.y), movingLamp(at.x + 0.01, at.y));
        EXPECT_LE(largest, 0.01) << "above, at " << at.x;
        worst = std::max(worst, largest);
    }
    for (const glm::dvec2 at : among) {
        const double largest = pop(movingLamp(at.x, at.y, 0.7), movingLamp(at.x + 0.01, at.y, 0.7));
        EXPECT_LE(largest, 0.01) << "among the balls, at " << at.x;
        worst = std::max(worst, largest);
    }
    std::printf("changes of per_object beside those of every: up to %.2f %% of the local radiance\n",
                100 * worst);
    EXPECT_GT(worst, 0) << "it is not every that was drawn";
    // Negative control: without the fade, a light that changes its group shows the whole difference
    // between the groups.
    const Scene scene = movingLamp(10.2);
    const Frame every = drawn(scene, Assignment::every, 0);
    const double jump =
        popOf(every, every, drawn(scene, Assignment::per_object, 4), drawn(scene, Assignment::per_object, 3));
    EXPECT_GT(jump, 0.01);
}

TEST(PerObject, ALightmappedObjectGetsNoHarmonics) {
    Scene scene = loadScene("builtin:lightmaps");
    for (int i = 0; i < 10; ++i) {
        Light lamp;
        lamp.position = {0.3 * i - 1.5, 3, 2};
        lamp.intensity = 2;
        scene.lights.push_back(lamp);
    }
    Scene unmapped = scene;
    for (Material& m : unmapped.materials) m.lightmap_texture = {};
    const Settings settings = unshadowed();
    const auto diffuse = [](const Scene& s) {
        Settings objects;
        objects.size = {160, 90};
        objects.assign = Assignment::per_object;
        objects.pixel_lights = 0;
        const RenderOptions options = untimed({Channel::lit_diffuse});
        double sum = 0;
        const std::vector<Frame> frames = drawAll(s, {objects}, options);
        for (const float v : frames.front().channels.at(options.channels.front()).data) sum += double{v};
        return sum;
    };
    EXPECT_LT(diffuse(scene), 0.8 * diffuse(unmapped));
    EXPECT_GT(diffuse(scene), 0) << "the base and the vertex lights are there";
}

// The light that a square reflects from vertex lights and harmonics, against lists made on the CPU.
// Without a specular layer, radiance is albedo / pi times irradiance. The square and its camera rotate
// together. Every second turn has --range-window squared and --spot-cone smoothstep.
TEST(PerObject, WhatIsReflectedIsTheIrradianceOfTheLists) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vec = [&] { return glm::normalize(glm::dvec3(unit(random), unit(random), unit(random))); };
    const glm::dvec3 albedo(0.8, 0.5, 0.25);
    double from_harmonics = 0, from_lists = 0;
    int fractions = 0;
    for (int turn = 0; turn < 12; ++turn) {
        const int pixels = turn % 2 == 0 ? 0 : 3;  // lights per pixel
        const glm::dvec3 n = vec(), right = glm::normalize(glm::cross(n, vec())), up = glm::cross(n, right);
        const glm::dmat4 turned(glm::dmat3(right, up, n));
        Scene scene = square();
        scene.nodes[0].parent_from_node = turned;
        scene.cameras[0].world_from_camera = turned * scene.cameras[0].world_from_camera;
        scene.materials[0].base_color = glm::vec4(glm::vec3(albedo), 1);
        scene.materials[0].metallic = 0;
        scene.materials[0].specular = 0;
        // Suns. The four brightest beyond the per-pixel lights are vertex lights, equal at all vertices.
        for (int i = 0; i < 14; ++i) {
            Light light;
            light.kind = i < 8 ? LightKind::directional : LightKind::point;
            light.direction = vec();
            light.position = (6.0 + i) * vec();
            light.range = 25;
            if (i >= 11) {  // aimed past the square, which is between their cones
                light.kind = LightKind::spot;
                light.direction = glm::normalize(0.3 * right - glm::normalize(light.position));
                light.inner_cone = 0.1f;
                light.outer_cone = 0.5f;
            }
            light.intensity = i < 8 ? std::exp2(-0.5f * static_cast<float>(i)) : 4;
            light.color = glm::abs(glm::vec3(vec()));
            if (pixels == 0) light.importance = Importance::not_important;
            scene.lights.push_back(light);
        }
        const View view = makeView(scene, poseAt(scene, 0), "0", 4, 4);
        Settings settings = image(Assignment::per_object, pixels, {4, 4});
        GpuLights lights = gpuLights(scene.lights, view.eye());
        if (pixels == 0) {
            settings.range_window = RangeWindow::squared;
            settings.spot_cone = SpotFalloff::smoothstep;
            lights.falloff = {.squared_window = true, .smooth_cones = true};
        }
        const ObjectPosition place{-view.eye(), glm::abs(right) + glm::abs(up)};
        const ObjectLightLists lists = objectLightLists(lights, std::span(&place, 1), pixels);
        const gpu::ObjectLights& object = lists.objects[0];
        ASSERT_EQ(object.begin == object.area_end, pixels == 0);
        ASSERT_EQ(object.local_begin, object.area_end) << "no point light is so bright";
        ASSERT_EQ(object.vertex_directional_end, object.vertex_end);
        glm::dvec3 listed(0);
        for (gpu::uint i = object.begin; i < object.vertex_end; ++i) {
            const gpu::Light& sun = lights.lights[lists.entries[i].light];
            const float fraction = lists.entries[i].weight;
            fractions += i < object.area_end && fraction > 0.02f && fraction < 0.98f;
            listed += glm::dvec3(sun.intensity) * double{fraction} *
                      std::max(glm::dot(n, glm::dvec3(sun.position)), 0.0);
        }
        const gpu::ObjectIrradiance& e = object.irradiance;
        const auto d = [](const gpu::vec3& v) { return glm::dvec3(v); };
        const glm::dvec3 linear = d(e.linear_x) * n.x + d(e.linear_y) * n.y + d(e.linear_z) * n.z,
                         mixed = d(e.xy) * n.x * n.y + d(e.yz) * n.y * n.z + d(e.xz) * n.x * n.z,
                         squares = d(e.xx) * (n.x * n.x - n.z * n.z) + d(e.yy) * (n.y * n.y - n.z * n.z);
        const glm::dvec3 harmonics = glm::max(d(e.constant) + linear + squares + 2.0 * mixed, 0.0);
        const glm::dvec3 expected = albedo / glm::pi<double>() * (listed + harmonics);
        const Frame frame = drawnAll(scene, {settings}).front();
        // 1e-5: a dozen float32 roundings of sums that partly cancel.
        for (const glm::ivec2 p : {glm::ivec2(0, 0), {2, 1}, {3, 3}})
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(frame.channels.at(Channel::lit).at(p.x, p.y, c), expected[c],
                            1e-5 * (1 + expected[c]))
                    << turn;
        from_harmonics += harmonics.g;
        from_lists += listed.g;
    }
    EXPECT_GT(from_harmonics, 0.1 * from_lists);
    EXPECT_GT(from_lists, 0.1 * from_harmonics);
    EXPECT_GE(fractions, 2) << "lights shaded per pixel of which the harmonics have a part";
}

// A double-sided square under a vertex light is as bright from behind as from the front.
TEST(PerObject, VertexLightsReachTheBackOfADoubleSidedMaterial) {
    Scene scene = square();
    scene.materials[0].double_sided = true;
    scene.materials[0].metallic = 0;
    Light lamp;
    lamp.position = {0, 0, 20};
    lamp.intensity = 400;
    scene.lights = {lamp};
    const float front =
        drawn(scene, Assignment::per_object, 0, {16, 16}).channels.at(Channel::lit).at(8, 8, 0);
    scene.nodes[0].parent_from_node[0].x = scene.nodes[0].parent_from_node[2].z = -1;  // by 180 degrees
    const float back =
        drawn(scene, Assignment::per_object, 0, {16, 16}).channels.at(Channel::lit).at(8, 8, 0);
    EXPECT_GT(front, 0.05f);
    EXPECT_NEAR(back, front, 1e-5f * front);
}

}  // namespace
}  // namespace diptych::tests
