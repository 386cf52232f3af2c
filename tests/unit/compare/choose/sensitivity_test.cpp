// SPDX-License-Identifier: MIT
// Break-even points of times with a known law, under noise; and variations of a scene.
#include "compare/choose/sensitivity.h"
#include "compare/choose/variations.h"
#include "shared/scene/load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace diptych::choose {

namespace {

// Time fixed + each * value, ms.
struct Law {
    double fixed = 0, each = 0;
    double at(double value) const { return fixed + each * value; }
};

Variation lawful(const Law (&laws)[2], double value, double deviation, std::mt19937_64& random) {
    return {value, [&laws, value, deviation, &random](std::span<const std::size_t> order) {
                std::vector<double> times;
                for (const std::size_t i : order)
                    times.push_back(laws[i].at(value) *
                                    std::exp(std::normal_distribution<double>(0, deviation)(random)));
                return times;
            }};
}

Sensitivities decided(const Law (&laws)[2], double value, const std::vector<double>& others, double deviation,
                      std::uint64_t seed, double min = 1, double max = 100) {
    std::mt19937_64 random(seed);
    Property property{
        .name = "load", .unit = "things", .how = "more", .value = value, .min = min, .max = max};
    for (const double other : others)
        property.others.push_back([&, other] { return lawful(laws, other, deviation, random); });
    return analyzeSensitivity(lawful(laws, value, deviation, random).draw, {property}, 5);
}

// How often the 95 % interval contains the true value.
void expectHolds(const Law (&laws)[2], double value, const std::vector<double>& others, double truth,
                 bool extrapolated) {
    int found = 0, held = 0;
    double widest = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Sensitivities sensitivities = decided(laws, value, others, 0.01, seed);
        EXPECT_EQ(sensitivities.frames, 20 * (1 + others.size()));
        const auto& break_even = sensitivities.properties.front().break_even;
        if (!break_even) continue;
        ++found;
        held += break_even->low <= truth && truth <= break_even->high;
        widest = std::max(widest, break_even->high / break_even->low);
        EXPECT_EQ(break_even->extrapolated, extrapolated);
        EXPECT_TRUE(break_even->other_above);
    }
    EXPECT_GE(found, 198);
    EXPECT_GE(held, 0.9 * found) << "200 throws of 0.95 give fewer than 0.91 once in a hundred times";
    EXPECT_LE(widest, 4) << "an interval that says nothing would hold everything";
}

TEST(ChooseSensitivity, ACrossingBetweenMeasurementsIsInItsInterval) {
    const Law laws[2] = {{2, 1}, {10, 0.5}};  // equal at 16
    expectHolds(laws, 8, {4, 32}, 16, false);
}

TEST(ChooseSensitivity, ACrossingBeyondTheMeasurementsIsInItsInterval) {
    const Law laws[2] = {{2, 1}, {14, 0.5}};  // equal at 24
    expectHolds(laws, 8, {4, 16}, 24, true);
}

TEST(ChooseSensitivity, AVariationThatCannotBeDrawnIsSaidAndTheOthersAreKept) {
    const Law laws[2] = {{2, 1}, {10, 0.5}};  // equal at 16
    std::mt19937_64 random(1);
    const auto fails = []() -> Variation { throw std::runtime_error("too large for this device"); };
    Property lost{.name = "lost", .unit = "things", .how = "more", .value = 8, .min = 1, .max = 100};
    lost.others = {fails};
    Property kept = lost;
    kept.name = "kept";
    kept.others.push_back([&] { return lawful(laws, 32, 0.001, random); });
    const Sensitivities sensitivities =
        analyzeSensitivity(lawful(laws, 8, 0.001, random).draw, {lost, kept}, 5);
    for (const PropertySensitivity& sensitivity : sensitivities.properties) {
        const bool is_kept = sensitivity.property.name == "kept";
        EXPECT_EQ(sensitivity.property.not_varied, is_kept ? "" : "too large for this device");
        EXPECT_EQ(sensitivity.break_even.has_value(), is_kept);
    }
}

TEST(ChooseSensitivity, WhereNoValueTurnsItNoneIsSaid) {
    const Law laws[2] = {{2, 1}, {4, 1}};
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Sensitivities sensitivities = decided(laws, 8, {4, 16}, 0.005, seed, 1, 32);
        EXPECT_FALSE(sensitivities.properties.front().isReversed());
    }
    const Sensitivities still = decided(laws, 8, {4, 16}, 0, 1);
    EXPECT_FALSE(still.properties.front().open);
}

// Parallel lines cross somewhere by noise. The result stays open and is not reported as a break-even
// point.
TEST(ChooseSensitivity, ACrossingThatNoiseMakesIsLeftOpen) {
    const Law laws[2] = {{2, 1}, {2.2, 1}};
    int turned = 0, open = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Sensitivities sensitivities = decided(laws, 8, {4, 16}, 0.02, seed);
        turned += sensitivities.properties.front().isReversed();
        open += sensitivities.properties.front().open.has_value();
    }
    EXPECT_LE(turned, 20);
    EXPECT_GE(open, 180);
}

TEST(ChooseSensitivity, TheOtherPathWinsBelow) {
    const Law laws[2] = {{10, 0.5}, {2, 1}};
    const Sensitivities sensitivities = decided(laws, 32, {8}, 0, 1);
    ASSERT_TRUE(sensitivities.properties.front().break_even);
    EXPECT_NEAR(sensitivities.properties.front().break_even->value, 16, 1e-6);
    EXPECT_FALSE(sensitivities.properties.front().break_even->other_above);
}

// A property with few values is not interpolated.
TEST(ChooseSensitivity, FewValuesAreToldAsMeasured) {
    std::mt19937_64 random(1);
    const Law laws[2] = {{2, 1}, {4, 0.25}};
    Property samples{
        .name = "MSAA", .unit = "samples", .how = "", .value = 1, .min = 1, .max = 8, .few_values = true};
    samples.others.push_back([&] { return lawful(laws, 4, 0.01, random); });
    Property nothing = samples;
    nothing.others.clear();
    nothing.not_varied = "not here";
    const Sensitivities sensitivities =
        analyzeSensitivity(lawful(laws, 1, 0.01, random).draw, {nothing, samples}, 5);
    EXPECT_EQ(sensitivities.properties[0].reversed_at, 4) << "what turns the choice comes first";
    EXPECT_FALSE(sensitivities.properties[0].break_even);
    EXPECT_FALSE(sensitivities.properties[1].isReversed());
}

std::size_t trianglesOf(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives) count += primitive.indices.size() / 3;
    return count;
}

TEST(SceneVariations, ChangeOneThing) {
    const Scene scene = loadScene("builtin:spots", {});
    ASSERT_GE(scene.lights.size(), 4u);
    const Scene fewer = withLights(scene, scene.lights, 0.5), more = withLights(scene, scene.lights, 4);
    EXPECT_EQ(fewer.lights.size(), (scene.lights.size() + 1) / 2);
    EXPECT_EQ(more.lights.size(), 4 * scene.lights.size());
    EXPECT_EQ(trianglesOf(withEmptyTriangles(scene, 8)), 9 * trianglesOf(scene));
    const Scene below = withOverdraw(scene, 1);
    EXPECT_EQ(trianglesOf(below), 2 * trianglesOf(scene));
    const Primitive &before = scene.meshes.front().primitives.front(),
                    &after = below.meshes.front().primitives.front();
    ASSERT_EQ(after.positions.size(), 2 * before.positions.size());
    EXPECT_EQ(after.indices[3], before.indices[0]) << "a triangle follows its copy";
    EXPECT_EQ(after.indices[0], before.indices[0] + before.positions.size());
    const glm::vec3 moved = before.positions[0] - after.positions[before.positions.size()];
    EXPECT_GT(glm::dot(moved, before.normals[0]), 0) << "below the surface";
    for (const Mesh& mesh : withBlends(scene, true).meshes)
        for (const Primitive& primitive : mesh.primitives) EXPECT_GE(primitive.material, 0);
    for (const Material& material : withBlends(scene, true).materials) EXPECT_TRUE(blends(material));
    for (const Material& material : withBlends(scene, false).materials) EXPECT_FALSE(blends(material));
}

}  // namespace

}  // namespace diptych::choose
