// SPDX-License-Identifier: MIT
// Images of metamorphic relations: allowed and forbidden differences are told apart.
#include "compare/audit/relate.h"
#include "compare/audit/relations.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::audit {

namespace {

constexpr int relatedWidth = 16, relatedHeight = 8;

// Without a sheen and a film: two walls, of material 0 on the left at 2 m and of material 1 on the right at 3
// m, lit evenly.
Frame twoWalls() {
    Frame frame;
    frame.settings.size = {relatedWidth, relatedHeight};
    for (const Channel channel : relatedChannels())
        frame.channels[channel] = Image(relatedWidth, relatedHeight, debugMode(channel).width, 0.5f);
    for (int y = 0; y < relatedHeight; ++y)
        for (int x = 0; x < relatedWidth; ++x) {
            const bool right = x >= relatedWidth / 2;
            frame.channels[Channel::material_id].at(x, y) = right ? 1.0f : 0.0f;
            frame.channels[Channel::depth].at(x, y) = right ? 3.0f : 2.0f;
            for (const Channel channel : {Channel::normals, Channel::geometric_normal})
                for (int c = 0; c < 3; ++c) frame.channels[channel].at(x, y, c) = c == 2 ? 1.0f : 0.0f;
        }
    for (const Channel channel : {Channel::sheen_color, Channel::sheen_roughness, Channel::iridescence,
                                  Channel::iridescence_thickness})
        std::ranges::fill(frame.channels.at(channel).data, 0.0f);
    return frame;
}

RelationTolerance toleranceFor(Equality equality) {
    RelationTolerance tolerance;
    tolerance.equality = equality;
    if (equality != Equality::bits) tolerance.relative = 1e-6;
    if (equality == Equality::rounding) tolerance.step = 0x1p-7;
    return tolerance;
}

// Turns a normal of two walls, and changes its light by `slope` times as much.
bool passesTurned(const Frame& original, double slope) {
    Frame changed = original;
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.relative = 1e-5;
    changed.channels[Channel::normals].at(2, 3, 0) = 0.9e-5f;
    changed.channels[Channel::lit].at(2, 3, 0) *= static_cast<float>(1 + slope * 0.9e-5);
    return evaluate(original, changed, tolerance).passes();
}

float above(float value, int ulps = 1) {
    for (int i = 0; i < ulps; ++i) value = std::nextafter(value, 10.0f);
    return value;
}

}  // namespace

TEST(RelationResult, BitsAreTheSameOrNot) {
    const Frame original = twoWalls();
    EXPECT_TRUE(evaluate(original, original, toleranceFor(Equality::bits)).passes());
    EXPECT_EQ(evaluate(original, original, toleranceFor(Equality::bits)).worst(), nullptr);
    for (const Channel channel : relatedChannels()) {
        Frame changed = original;
        float& value = changed.channels[channel].at(3, 2, debugMode(channel).width - 1);
        value = above(value);
        const FrameResult result = evaluate(original, changed, toleranceFor(Equality::bits));
        EXPECT_FALSE(result.passes()) << debugMode(channel).name;
        ASSERT_NE(result.worst(), nullptr);
        EXPECT_EQ(result.worst()->mode, channel);
        EXPECT_EQ(result.worst()->x, 3);
        EXPECT_EQ(result.worst()->y, 2);
        EXPECT_EQ(result.worst()->beyond, 1u);
    }
}

TEST(RelationResult, OtherPipelinesMayRoundOtherwiseOnAGpu) {
    const Frame original = twoWalls();
    RelationTolerance tolerance = toleranceFor(Equality::bits);
    tolerance.ulps = 16;
    Frame changed = original;
    float& value = changed.channels[Channel::lit].at(3, 2, 1);
    value = above(value, 16);
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    EXPECT_EQ(evaluate(original, changed, tolerance).worst()->error, 16);
    value = above(value);
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
}

// Light of a coat moves with the coat's own normal.
TEST(RelationResult, ACoatsNormalMovesLight) {
    Frame original = twoWalls();
    original.channels[Channel::clearcoat_normal] = original.channels[Channel::normals];
    Frame changed = original;
    changed.channels[Channel::lit].at(3, 2, 0) *= 1 + 1e-4f;
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.relative = 2e-5;  // of the normal
    changed.channels[Channel::clearcoat_normal].at(3, 2, 0) = 1e-5f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    for (Frame* frame : {&original, &changed}) frame->channels.erase(Channel::clearcoat_normal);
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes()) << "without a coat";
}

// The base's lobe grants 12 times the normal's rotation, a sheen of roughness 0.1 204 times more.
TEST(RelationResult, ASheensLightMovesWithTheNormal) {
    Frame original = twoWalls();
    std::ranges::fill(original.channels[Channel::sheen_roughness].data, 0.1f);
    EXPECT_FALSE(passesTurned(original, 200)) << "a sheen without colour is none";
    std::ranges::fill(original.channels[Channel::sheen_color].data, 0.5f);
    EXPECT_TRUE(passesTurned(original, 200));
    EXPECT_FALSE(passesTurned(original, 230));
    // No sheen is smoother than 0.045.
    std::ranges::fill(original.channels[Channel::sheen_roughness].data, 0.0f);
    EXPECT_TRUE(passesTurned(original, 900));
    EXPECT_FALSE(passesTurned(original, 1100));
}

TEST(RelationResult, AFilmsLightMovesWithTheNormal) {
    Frame original = twoWalls();
    EXPECT_FALSE(passesTurned(original, 35));
    std::ranges::fill(original.channels[Channel::iridescence].data, 0.5f);
    EXPECT_TRUE(passesTurned(original, 35));
    EXPECT_FALSE(passesTurned(original, 60));
}

// A half's rounding of a thickness is relative to it.
TEST(RelationResult, APackedThicknessIsGrantedItsPart) {
    Frame original = twoWalls();
    std::ranges::fill(original.channels[Channel::iridescence_thickness].data, 400.0f);
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.packed[Channel::iridescence_thickness] = 0x1p-11;
    Frame changed = original;
    changed.channels[Channel::iridescence_thickness].at(3, 2, 0) += 0.9f * 2 * 400 * 0x1p-11f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    changed.channels[Channel::iridescence_thickness].at(3, 2, 0) += 0.2f * 2 * 400 * 0x1p-11f;
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
}

TEST(RelationResult, SumsAreGrantedByComponent) {
    Frame original = twoWalls();
    original.channels[Channel::lit].at(5, 5, 2) = 1e-6f;
    Frame changed = original;
    changed.channels[Channel::lit].at(3, 2, 0) *= 1 + 5e-7f;
    EXPECT_TRUE(evaluate(original, changed, toleranceFor(Equality::sums)).passes());
    // Small for the pixel, but large for its blue component.
    changed.channels[Channel::lit].at(5, 5, 2) = 1.1e-6f;
    const FrameResult result = evaluate(original, changed, toleranceFor(Equality::sums));
    EXPECT_FALSE(result.passes());
    EXPECT_EQ(result.worst()->x, 5);
    // Surface channels are not sums of light.
    changed = original;
    changed.channels[Channel::albedo].at(3, 2, 0) = above(0.5f);
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::sums)).passes());
}

TEST(RelationResult, RoundingIsGrantedByWhatChangesToTheNextPixel) {
    Frame original = twoWalls();
    for (int y = 0; y < relatedHeight; ++y) original.channels[Channel::lit].at(4, y, 0) = 0.6f;
    Frame changed = original;
    changed.channels[Channel::lit].at(4, 3, 0) += 0.9f * 0.1f * 0x1p-7f;
    EXPECT_TRUE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
    changed.channels[Channel::lit].at(4, 3, 0) += 0.2f * 0.1f * 0x1p-7f;
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
    // No tolerance where neighbouring pixels are equal.
    changed = original;
    changed.channels[Channel::lit].at(1, 3, 0) += 0.9f * 0.1f * 0x1p-7f;
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
}

TEST(RelationResult, LightFollowsANormalAsFastAsItsLobe) {
    const Frame original = twoWalls();
    Frame changed = original;
    // Roughness 0.5, alpha 0.25: light may change by 12 times the normal's rotation.
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.relative = 1e-5;
    changed.channels[Channel::normals].at(2, 3, 0) = 0.9e-5f;
    changed.channels[Channel::lit].at(2, 3, 0) *= 1 + 11 * 0.9e-5f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    changed.channels[Channel::lit].at(2, 3, 0) *= 1 + 5 * 0.9e-5f;
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
}

TEST(RelationResult, AnotherSurfaceIsSetAsideBesideAnEdgeAlone) {
    const Frame original = twoWalls();
    const auto shows = [&](int x, int y) {
        Frame changed = original;
        changed.channels[Channel::material_id].at(x, y) = 1;
        changed.channels[Channel::depth].at(x, y) = 3;
        changed.channels[Channel::lit].at(x, y, 0) = 0.9f;
        return changed;
    };
    const FrameResult beside =
        evaluate(original, shows(relatedWidth / 2 - 1, 3), toleranceFor(Equality::rounding));
    EXPECT_TRUE(beside.passes());
    EXPECT_EQ(beside.excluded, 1u);
    EXPECT_EQ(beside.max_excluded, 8u) << "of few edges";
    // In the middle of a wall the changed pixel makes its own edge, but the given image has none there.
    EXPECT_FALSE(evaluate(original, shows(2, 3), toleranceFor(Equality::rounding)).passes());
    // A whole column exceeds the allowed number of pixels.
    Frame changed = original;
    for (int y = 0; y < relatedHeight; ++y)
        for (const int x : {relatedWidth / 2 - 1, relatedWidth / 2})
            changed.channels[Channel::material_id].at(x, y) =
                1 - original.channels.at(Channel::material_id).at(x, y);
    EXPECT_GT(evaluate(original, changed, toleranceFor(Equality::rounding)).excluded, 8u);
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
    // Bitwise equality has no tolerance at edges.
    EXPECT_FALSE(evaluate(original, shows(relatedWidth / 2 - 1, 3), toleranceFor(Equality::bits)).passes());
}

TEST(RelationResult, OfOneDepthEitherSurfaceMayBeSeen) {
    const Frame original = twoWalls();
    RelationTolerance tolerance = toleranceFor(Equality::bits);
    tolerance.reorders = true;
    Frame changed = original;
    changed.channels[Channel::material_id].at(2, 3) = 1;
    changed.channels[Channel::lit].at(2, 3, 0) = 0.9f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    EXPECT_EQ(evaluate(original, changed, tolerance).excluded, 1u);
    changed.channels[Channel::depth].at(2, 3) = 1.5f;
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
    // The same surface must have the same light.
    changed = original;
    changed.channels[Channel::lit].at(2, 3, 0) = 0.9f;
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
}

TEST(RelationResult, AFilterMayWeightOtherwiseOfFewPixels) {
    const Frame original = twoWalls();
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.textured = {true, false};
    tolerance.filter_step = 0x1p-7;
    Frame changed = original;
    changed.channels[Channel::albedo].at(2, 3, 1) += 0x1p-8f;
    changed.channels[Channel::lit].at(2, 3, 1) += 0x1p-8f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    EXPECT_EQ(evaluate(original, changed, tolerance).filtered, 1u);
    Frame wrong = changed;
    wrong.channels[Channel::albedo].at(2, 3, 1) += 0.25f;
    EXPECT_FALSE(evaluate(original, wrong, tolerance).passes()) << "its light alone is excused";
    Frame more = original;
    for (int y = 0; y < relatedHeight; ++y)
        for (int x = 0; x < 2; ++x) more.channels[Channel::albedo].at(x, y, 1) += 0x1p-8f;
    EXPECT_FALSE(evaluate(original, more, tolerance).passes());
    tolerance.textured = {false, false};
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes()) << "there is no texture";
}

TEST(RelationResult, WhatIsNoNumberIsBroken) {
    const Frame original = twoWalls();
    for (const Equality equality : {Equality::bits, Equality::sums, Equality::rounding}) {
        Frame changed = original;
        changed.channels[Channel::lit].at(2, 3, 0) = std::numeric_limits<float>::quiet_NaN();
        EXPECT_FALSE(evaluate(original, changed, toleranceFor(equality)).passes()) << nameOf(equality);
    }
    // A share of infinite light is infinite and must not allow anything.
    Frame endless = original;
    endless.channels[Channel::lit].at(2, 3, 0) = std::numeric_limits<float>::infinity();
    for (const Equality equality : {Equality::bits, Equality::sums, Equality::rounding})
        EXPECT_FALSE(evaluate(endless, original, toleranceFor(equality)).passes()) << nameOf(equality);
}

TEST(RelationResult, ImagesAreMappedBack) {
    Frame changed = twoWalls();
    changed.channels[Channel::lit].at(5, 2, 0) = 8;
    changed.channels[Channel::normals].at(5, 2, 0) = 1;
    changed.channels[Channel::normals].at(5, 2, 2) = 0;
    PixelMap map;
    map.border = 1;
    map.mirrored = true;
    map.light = 4;
    map.length = 2;
    map.rotation = glm::dmat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0});  // +X becomes -Z
    map.ids = {1, 0};
    const Frame back = mappedBack(changed, map);
    EXPECT_EQ(back.settings.size, (Size{relatedWidth - 2, relatedHeight - 2}));
    const int x = relatedWidth - 2 - 1 - (5 - 1), y = 1;
    EXPECT_EQ(back.channels.at(Channel::lit).at(x, y, 0), 2);
    EXPECT_EQ(back.channels.at(Channel::depth).at(x, y), 1);
    EXPECT_EQ(back.channels.at(Channel::material_id).at(x, y), 1);
    EXPECT_EQ(back.channels.at(Channel::normals).at(x, y, 2), 1) << "+X of the changed one was +Z";
    EXPECT_EQ(back.channels.at(Channel::normals).at(x, y, 0), 0);
}

}  // namespace diptych::audit
