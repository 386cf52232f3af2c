// SPDX-License-Identifier: MIT
// Break-even points of times with a known law, under noise; and variations of a scene.
#include "compare/choose/deciders.h"
#include "compare/cli/scene_variations.h"
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

Deciders decided(const Law (&laws)[2], double value, const std::vector<double>& others, double deviation,
                 std::uint64_t seed, double least = 1, double most = 100) {
    std::mt19937_64 random(seed);
    Property property{
        .name = "load", .unit = "things", .how = "more", .value = value, .least = least, .most = most};
    for (const double other : others)
        property.others.push_back([&, other] { return lawful(laws, other, deviation, random); });
    return findDeciders(lawful(laws, value, deviation, random).draw, {property}, 5);
}

// How often the 95 % interval contains the true value.
void expectHolds(const Law (&laws)[2], double value, const std::vector<double>& others, double truth,
                 bool extrapolated) {
    int found = 0, held = 0;
    double widest = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Deciders deciders = decided(laws, value, others, 0.01, seed);
        EXPECT_EQ(deciders.frames, 20 * (1 + others.size()));
        const auto& crossing = deciders.properties.front().crossing;
        if (!crossing) continue;
        ++found;
        held += crossing->low <= truth && truth <= crossing->high;
        widest = std::max(widest, crossing->high / crossing->low);
        EXPECT_EQ(crossing->extrapolated, extrapolated);
        EXPECT_TRUE(crossing->other_above);
    }
    EXPECT_GE(found, 198);
    EXPECT_GE(held, 0.9 * found) << "200 throws of 0.95 give fewer than 0.91 once in a hundred times";
    EXPECT_LE(widest, 4) << "an interval that says nothing would hold everything";
}

TEST(ChooseDeciders, ACrossingBetweenMeasurementsIsInItsInterval) {
    const Law laws[2] = {{2, 1}, {10, 0.5}};  // equal at 16
    expectHolds(laws, 8, {4, 32}, 16, false);
}

TEST(ChooseDeciders, ACrossingBeyondTheMeasurementsIsInItsInterval) {
    const Law laws[2] = {{2, 1}, {14, 0.5}};  // equal at 24
    expectHolds(laws, 8, {4, 16}, 24, true);
}

TEST(ChooseDeciders, AVariationThatCannotBeDrawnIsSaidAndTheOthersAreKept) {
    const Law laws[2] = {{2, 1}, {10, 0.5}};  // equal at 16
    std::mt19937_64 random(1);
    const auto fails = []() -> Variation { throw std::runtime_error("too large for this device"); };
    Property lost{.name = "lost", .unit = "things", .how = "more", .value = 8, .least = 1, .most = 100};
    lost.others = {fails};
    Property kept = lost;
    kept.name = "kept";
    kept.others.push_back([&] { return lawful(laws, 32, 0.001, random); });
    const Deciders deciders = findDeciders(lawful(laws, 8, 0.001, random).draw, {lost, kept}, 5);
    for (const Decider& decider : deciders.properties) {
        const bool is_kept = decider.property.name == "kept";
        EXPECT_EQ(decider.property.not_varied, is_kept ? "" : "too large for this device");
        EXPECT_EQ(decider.crossing.has_value(), is_kept);
    }
}

TEST(ChooseDeciders, WhereNoValueTurnsItNoneIsSaid) {
    const Law laws[2] = {{2, 1}, {4, 1}};
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Deciders deciders = decided(laws, 8, {4, 16}, 0.005, seed, 1, 32);
        EXPECT_FALSE(deciders.properties.front().isTurned());
    }
    const Deciders still = decided(laws, 8, {4, 16}, 0, 1);
    EXPECT_FALSE(still.properties.front().open);
}

// Parallel lines cross somewhere by noise. The result stays open and is not reported as a crossing.
TEST(ChooseDeciders, ACrossingThatNoiseMakesIsLeftOpen) {
    const Law laws[2] = {{2, 1}, {2.2, 1}};
    int turned = 0, open = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Deciders deciders = decided(laws, 8, {4, 16}, 0.02, seed);
        turned += deciders.properties.front().isTurned();
        open += deciders.properties.front().open.has_value();
    }
    EXPECT_LE(turned, 20);
    EXPECT_GE(open, 180);
}

TEST(ChooseDeciders, TheOtherPathWinsBelow) {
    const Law laws[2] = {{10, 0.5}, {2, 1}};
    const Deciders deciders = decided(laws, 32, {8}, 0, 1);
    ASSERT_TRUE(deciders.properties.front().crossing);
    EXPECT_NEAR(deciders.properties.front().crossing->value, 16, 1e-6);
    EXPECT_FALSE(deciders.properties.front().crossing->other_above);
}

// A property with few values is not interpolated.
TEST(ChooseDeciders, FewValuesAreToldAsMeasured) {
    std::mt19937_64 random(1);
    const Law laws[2] = {{2, 1}, {4, 0.25}};
    Property samples{
        .name = "MSAA", .unit = "samples", .how = "", .value = 1, .least = 1, .most = 8, .few_values = true};
    samples.others.push_back([&] { return lawful(laws, 4, 0.01, random); });
    Property nothing = samples;
    nothing.others.clear();
    nothing.not_varied = "not here";
    const Deciders deciders = findDeciders(lawful(laws, 1, 0.01, random).draw, {nothing, samples}, 5);
    EXPECT_EQ(deciders.properties[0].turns_at, 4) << "what turns the choice comes first";
    EXPECT_FALSE(deciders.properties[0].crossing);
    EXPECT_FALSE(deciders.properties[1].isTurned());
}

}  // namespace

}  // namespace diptych::choose

namespace diptych::cli {

namespace {

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

}  // namespace diptych::cli
