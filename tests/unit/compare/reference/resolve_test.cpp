// SPDX-License-Identifier: MIT
// Resolving a pixel's samples: the mean of their radiance, or weighted by a tone curve.
#include "compare/reference/resolve.h"

#include "tests/support/reference_scene.h"

#include <utility>
#include <vector>

namespace diptych::reference {
namespace {

Drawn resolved(const Scene& scene, const View& view, int samples, Resolve resolve,
               const std::map<Channel, Image>* surfaces = nullptr) {
    Drawn result{poseAt(scene, 0), {}};
    result.image = draw({.scene = scene,
                         .pose = result.pose,
                         .view = view,
                         .lights = result.pose.lights,
                         .mode = surfaces ? ReferenceMode::surface : ReferenceMode::scene,
                         .samples = samples,
                         .resolve = resolve,
                         .surfaces = surfaces});
    return result;
}

glm::dvec3 radianceOf(const Image& image, int x = 0, int y = 0) {
    return {double{image.at(x, y, 0)}, double{image.at(x, y, 1)}, double{image.at(x, y, 2)}};
}

const glm::vec3 lampRadiance(9, 0.5f, 2), floorRadiance(0.125f, 0.25f, 0);
const View onePixelView = viewFrom({0, 0, 3}, {0, 0, 0}, 1, 1, 0.01);

// A dimly glowing black floor, and a bright sheet above it where x < 0: half of the pixel.
Scene halfCovered() {
    Scene scene = floorScene();
    scene.materials[0].base_color = {0, 0, 0, 1};
    scene.materials.push_back(scene.materials[0]);
    scene.materials[0].emissive = floorRadiance;
    scene.materials[1].emissive = lampRadiance;
    add(scene, quad({-1, -1, 0.5}, {1, 0, 0}, {0, 2, 0}, 1));
    return scene;
}

TEST(ReferenceResolve, AHalfCoveredPixel) {
    for (const int samples : {64, 256}) {
        const glm::dvec3 mean =
            radianceOf(resolved(halfCovered(), onePixelView, samples, Resolve::linear)[Channel::lit]);
        // With evenly spread samples, an integer number is on either side.
        const glm::dvec3 a(lampRadiance), b(floorRadiance);
        const double covered = std::round(samples * (mean.x - b.x) / (a.x - b.x)), rest = samples - covered;
        EXPECT_NEAR(covered, samples / 2, 1);
        const glm::dvec3 lit =
            radianceOf(resolved(halfCovered(), onePixelView, samples, Resolve::tonemapped)[Channel::lit]);
        const double wa = 1 / (1 + 9.0), wb = 1 / (1 + 0.25);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c], (covered * a[c] + rest * b[c]) / samples, 1e-6 * a[c]);
            EXPECT_NEAR(lit[c], (covered * wa * a[c] + rest * wb * b[c]) / (covered * wa + rest * wb),
                        1e-6 * a[c])
                << c;
        }
        EXPECT_LT(lit.x, 0.4 * mean.x) << "the lamp decides the edge no longer";
    }
}

// Covers half of the pixel with a surface, or with a fully opaque blended layer. Weights use the visible
// light, after blending.
TEST(ReferenceResolve, WhatBlendsIsWeightedAsItIsSeen) {
    Scene scene = halfCovered();
    scene.materials[1].alpha_mode = AlphaMode::blend;
    const Drawn solid = resolved(halfCovered(), onePixelView, 64, Resolve::tonemapped),
                layer = resolved(scene, onePixelView, 64, Resolve::tonemapped);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(radianceOf(solid[Channel::lit])[c], radianceOf(layer[Channel::lit])[c], 1e-6) << c;
    // Surfaces behind the layer are resolved as if it were absent: half of it is another bright sheet.
    Scene behind = floorScene();
    behind.materials = scene.materials;
    behind.materials[1].alpha_mode = AlphaMode::opaque;
    behind.materials[1].emissive = {0, 4, 1};
    add(behind, quad({-1, 0, 0.25}, {2, 0, 0}, {0, 1, 0}, 1));
    scene = behind;
    scene.materials.push_back(halfCovered().materials[1]);
    scene.materials[2].alpha_mode = AlphaMode::blend;
    add(scene, quad({-1, -1, 0.5}, {1, 0, 0}, {0, 2, 0}, 2));
    const Drawn bare = resolved(behind, onePixelView, 64, Resolve::tonemapped),
                covered = resolved(scene, onePixelView, 64, Resolve::tonemapped);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(radianceOf(covered.image.unblended)[c], radianceOf(bare[Channel::lit])[c], 1e-6) << c;
    EXPECT_GT(radianceOf(covered[Channel::lit]).x, 1) << "the layer is there";
}

// A pixel with a single radiance keeps it in either mode. A single sample and the captured surface (one
// sample) keep it bit for bit.
TEST(ReferenceResolve, OfOneRadianceIsThatRadiance) {
    Scene scene = halfCovered();
    scene.materials[0].emissive = lampRadiance;
    const glm::dvec3 lit = radianceOf(resolved(scene, onePixelView, 64, Resolve::tonemapped)[Channel::lit]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], double{lampRadiance[c]}, 1e-6);
    scene = halfCovered();
    scene.lights = {lightOf(LightKind::point, {0.3, 0, 2})};
    const View view = viewFrom({2, 1, 1.5}, {0, 0, 0}, 9, 7);
    const Drawn one = resolved(scene, view, 1, Resolve::linear);
    EXPECT_EQ(one.image.channels.at(Channel::lit).data,
              resolved(scene, view, 1, Resolve::tonemapped).image.channels.at(Channel::lit).data);
    const std::map<Channel, Image>& surfaces = one.image.channels;
    EXPECT_EQ(resolved(scene, view, 1, Resolve::linear, &surfaces).image.channels.at(Channel::lit).data,
              resolved(scene, view, 1, Resolve::tonemapped, &surfaces).image.channels.at(Channel::lit).data);
}

// The light's components get the weights of the total, so they still add up to it.
TEST(ReferenceResolve, PartsAddUpToLit) {
    Scene scene = halfCovered();
    for (Material& m : scene.materials) {
        m.emissive = {0, 0, 0};
        m.base_color = {0.5f, 0.75f, 1, 1};
        m.specular = 1;
        m.roughness = 0.3f;
    }
    scene.materials[1].base_color = {0, 0.01f, 0, 1};
    scene.lights = {lightOf(LightKind::point, {0.3, 0, 2})};
    scene.lights[0].intensity = 100;
    const View view = viewFrom({0.5, 1, 1.5}, {0, 0, 0}, 5, 5);
    const Drawn d = resolved(scene, view, 16, Resolve::tonemapped),
                mean = resolved(scene, view, 16, Resolve::linear);
    int changed = 0;
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x) {
            const glm::dvec3 lit = radianceOf(d[Channel::lit], x, y);
            const glm::dvec3 parts =
                radianceOf(d[Channel::lit_diffuse], x, y) + radianceOf(d[Channel::lit_specular], x, y);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], parts[c], 1e-6 * lit[c]) << x << " " << y;
            changed += lit.y < 0.999 * radianceOf(mean[Channel::lit], x, y).y;
        }
    EXPECT_GE(changed, 4) << "or the picture has no edges";
}

// ---- uncertainty -------------------------------------------------------------------------------------

const double sampleRadiance[] = {0.01, 0.4, 3, 50};

// The mean of grey samples; one is off by `off` and has the uncertainty `known`.
Pixel meanOf(Resolve resolve, std::size_t which, double off, double known) {
    ResolvedLight light(resolve, 4);
    for (std::size_t i = 0; i < 4; ++i) {
        Pixel sample;
        sample.lit = sample.unblended = glm::dvec3(sampleRadiance[i] + (i == which ? off : 0));
        for (Shading* shading : {&sample.shading, &sample.blended})
            if (i == which) shading->uncertainty = shading->costs.sampled = known;
        light.add(sample);
    }
    Pixel mean;
    light.put(mean);
    return mean;
}

TEST(ReferenceResolve, TellsHowFarAnErrorOfASampleMovesIt) {
    for (const Resolve resolve : {Resolve::linear, Resolve::tonemapped})
        for (std::size_t i = 0; i < 4; ++i) {
            const double step = 1e-4 * (1 + sampleRadiance[i]);
            const double moved = (meanOf(resolve, i, step, 0).lit.x - meanOf(resolve, i, -step, 0).lit.x) / 2;
            const Pixel mean = meanOf(resolve, i, 0, step);
            for (const Shading* shading : {&mean.shading, &mean.blended}) {
                EXPECT_NEAR(shading->uncertainty, moved, 1e-3 * moved) << sampleRadiance[i];
                EXPECT_NEAR(shading->costs.sampled, moved, 1e-3 * moved) << sampleRadiance[i];
            }
        }
}

// Noise of one sample, small compared with the curve's bend. The bias of the mean over the noise is the
// stated uncertainty beyond the slope, times the other samples' share of the weight.
TEST(ReferenceResolve, TellsWhatTheCurveMakesOfNoise) {
    double weights = 0;
    for (const double c : sampleRadiance) weights += resolveWeight(Resolve::tonemapped, glm::dvec3(c));
    for (std::size_t i = 0; i < 4; ++i) {
        const double deviation = 0.005 * (1 + sampleRadiance[i]), known = 1.96 * deviation;
        const auto light = [&](double off) { return meanOf(Resolve::tonemapped, i, off, 0).lit.x; };
        const double bias = light(0) - (light(deviation) + light(-deviation)) / 2;
        const double tiny = 1e-6 * known;
        const double slope = meanOf(Resolve::tonemapped, i, 0, tiny).shading.uncertainty / tiny;
        const double bend = meanOf(Resolve::tonemapped, i, 0, known).shading.uncertainty - slope * known;
        const double others = 1 - resolveWeight(Resolve::tonemapped, glm::dvec3(sampleRadiance[i])) / weights;
        EXPECT_GT(bias, 0) << sampleRadiance[i];
        EXPECT_NEAR(bias, bend * others, 0.01 * bend) << sampleRadiance[i];
    }
}

TEST(ReferenceResolve, WeighsByTheLargestComponent) {
    EXPECT_EQ(resolveWeight(Resolve::linear, {9, 9, 9}), 1);
    EXPECT_EQ(resolveWeight(Resolve::tonemapped, {1, 3, 2}), 0.25);
    EXPECT_EQ(resolveWeight(Resolve::tonemapped, {-1, -3, -2}), 1) << "what is negative is 0";
}

}  // namespace
}  // namespace diptych::reference
