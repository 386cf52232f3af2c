// SPDX-License-Identifier: MIT
// Lights by object: what is given up with few of them per pixel, and that nothing pops.
#include "shared/contract/debug_mode.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>

namespace diptych::tests {
namespace {

constexpr int lit = static_cast<int>(gpu::DEBUG_lit);

Frame drawn(const Scene& scene, Assignment assign, int pixels, Size size = {160, 90}) {
    Settings settings;
    settings.path = Path::forward_plus;
    settings.size = size;
    settings.assign = assign;
    if (assign == Assignment::per_object) settings.pixel_lights = pixels;
    RenderOptions options;
    options.channels = {lit, static_cast<int>(gpu::DEBUG_light_count),
                        static_cast<int>(gpu::DEBUG_material_id)};
    options.runs = 0;
    return renderAll(device(), scene, {settings}, options).front();
}

// The mean of |a - b| over the mean of b.
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
        const Image every = drawn(scene, Assignment::every, 0).channels.at(lit);
        double last = 0;
        for (const int pixels : {8, 4, 2, 0}) {
            const Frame frame = drawn(scene, Assignment::per_object, pixels);
            const double error = meanError(frame.channels.at(lit), every);
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
        const Image counts = drawn(scene, Assignment::per_object, pixels).channels.at(gpu::DEBUG_light_count);
        const float most = *std::ranges::max_element(counts.data);
        EXPECT_LE(most, static_cast<float>(pixels + 1)) << "the sun is the base";
        EXPECT_GE(most, static_cast<float>(pixels));
    }
}

// Of the most that `every` shows around a pixel: what is bright there hides a change.
std::vector<double> localRadiance(const Image& image) {
    constexpr int reach = 4;
    std::vector<double> most(image.pixels());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, image.height - 1); ++v)
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, image.width - 1); ++u)
                    for (int c = 0; c < 3; ++c) {
                        double& local = most[static_cast<std::size_t>(y * image.width + x)];
                        local = std::max(local, double{image.at(u, v, c)});
                    }
    return most;
}

// By how much a step of the scene changes per_object otherwise than every, of the local radiance: the
// largest.
double popOf(const Frame& every, const Frame& everyNext, const Frame& object, const Frame& objectNext) {
    const Image &a = every.channels.at(lit), &b = everyNext.channels.at(lit), &c = object.channels.at(lit),
                &d = objectNext.channels.at(lit);
    const std::vector<double> local = localRadiance(a);
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i)
        for (int k = 0; k < 3; ++k) {
            const double change = double{b.pixel(i)[k]} - double{a.pixel(i)[k]};
            const double own = double{d.pixel(i)[k]} - double{c.pixel(i)[k]};
            if (local[i] > 0) largest = std::max(largest, std::abs(own - change) / local[i]);
        }
    return largest;
}

// Twelve lamps a few metres above nine balls and a floor of tiles, a tenth of which moves: it changes places
// with all of them in turn.
Scene movingLamp(double x) {
    Scene scene = loadScene("builtin:spheres?lights=0");
    for (int i = 0; i < 12; ++i) {
        Light lamp;
        lamp.position = {12 * std::cos(0.52 * i), 5 + 0.3 * i, 12 * std::sin(0.52 * i)};
        lamp.color = {1, 0.7f + 0.02f * static_cast<float>(i), 0.6f};
        lamp.intensity = 60;
        lamp.range = 40;
        scene.lights.push_back(lamp);
    }
    scene.lights.back().position.x += x;
    return scene;
}

TEST(PerObject, NothingPopsAsALightMovesByACentimetre) {
    double worst = 0;
    for (const double x : {-9.0, -6.0, -3.0, 0.0, 3.0, 6.0, 9.0}) {
        const Scene here = movingLamp(x), there = movingLamp(x + 0.01);
        const double pop =
            popOf(drawn(here, Assignment::every, 0), drawn(there, Assignment::every, 0),
                  drawn(here, Assignment::per_object, 4), drawn(there, Assignment::per_object, 4));
        EXPECT_LE(pop, 0.01) << "at " << x;
        worst = std::max(worst, pop);
    }
    EXPECT_GT(worst, 0) << "it is not every that was drawn";
    // The twin: without a fade a light that changes its group would show by all of what the groups differ by.
    const Scene scene = movingLamp(0);
    const Frame every = drawn(scene, Assignment::every, 0);
    const double jump =
        popOf(every, every, drawn(scene, Assignment::per_object, 4), drawn(scene, Assignment::per_object, 3));
    EXPECT_GT(jump, 0.01);
}

// What harmonics would add is dropped where a lightmap has it.
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
    const Settings settings;
    const auto diffuse = [](const Scene& s) {
        Settings objects;
        objects.size = {160, 90};
        objects.assign = Assignment::per_object;
        objects.pixel_lights = 0;
        RenderOptions options;
        options.channels = {static_cast<int>(gpu::DEBUG_lit_diffuse)};
        options.runs = 0;
        double sum = 0;
        const std::vector<Frame> frames = renderAll(device(), s, {objects}, options);
        for (const float v : frames.front().channels.at(options.channels.front()).data) sum += double{v};
        return sum;
    };
    EXPECT_LT(diffuse(scene), 0.8 * diffuse(unmapped));
    EXPECT_GT(diffuse(scene), 0) << "the base and the vertex lights are there";
}

}  // namespace
}  // namespace diptych::tests
