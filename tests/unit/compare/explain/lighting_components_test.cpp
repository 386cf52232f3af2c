// SPDX-License-Identifier: MIT
// Components of a difference that neither channels nor Settings explain, of hand-made terms of lit.
#include "compare/explain/lighting_components.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace diptych::tests {
namespace {

constexpr int termsWide = 4, termsHigh = 2;
constexpr std::size_t termPixels = 8;
const std::vector<Channel> termList{Channel::lit_diffuse, Channel::lit_specular, Channel::lit_ambient,
                                    Channel::lit_haze, Channel::transmittance};

Image ofTerms(float value, int components = 3) {
    return {termsWide, termsHigh, components, value};
}

// shaders/lib/shading/radiance.glsl: ((diffuse + specular + ambient) + emission) transmittance + haze.
Image litOfTerms(const Frame& frame) {
    Image lit = ofTerms(0);
    const auto of = [&](Channel channel, std::size_t i) { return frame.channels.at(channel).data[i]; };
    for (std::size_t i = 0; i < lit.data.size(); ++i)
        lit.data[i] = (of(Channel::lit_diffuse, i) + of(Channel::lit_specular, i) +
                       of(Channel::lit_ambient, i) + of(Channel::emission, i)) *
                          of(Channel::transmittance, i) +
                      of(Channel::lit_haze, i);
    return lit;
}

// Two Frames of equal terms, and our lighting of their surfaces, which reproduces both.
struct TermSides {
    std::array<Frame, 2> frames;  // baseline, test
    std::array<LitSurfaces, 2> own;

    TermSides() {
        for (Frame& frame : frames) {
            for (std::size_t t = 0; t < termList.size(); ++t)
                frame.channels[termList[t]] = ofTerms(0.5f * static_cast<float>(t + 1));
            frame.channels[Channel::transmittance] = ofTerms(0.5f);
            frame.channels[Channel::emission] = ofTerms(0.25f);
            frame.channels[Channel::material_id] = ofTerms(0, 1);
            for (const Channel count :
                 {Channel::shadow_visibility, Channel::local_visibility, Channel::light_count})
                frame.channels[count] = ofTerms(0.5f, 1);
            frame.channels[Channel::lit] = litOfTerms(frame);
        }
        for (std::size_t side = 0; side < 2; ++side) light(side);
    }
    // Our lighting of a side becomes what its Frame has.
    void light(std::size_t side) {
        const auto of = [&](Channel channel) { return frames.at(side).channels.at(channel); };
        own.at(side) = {of(Channel::lit),
                        {of(Channel::lit_diffuse),
                         of(Channel::lit_specular),
                         of(Channel::lit_ambient),
                         of(Channel::lit_haze),
                         of(Channel::transmittance),
                         {},
                         {},
                         {}},
                        &frames.at(side).channels.at(Channel::emission),
                        of(Channel::lit)};
    }
    Image& baseline(Channel channel) { return frames[0].channels.at(channel); }
    Image& test(Channel channel) { return frames[1].channels.at(channel); }
    LightingComponents components() const {
        return {frames[0], frames[1], frames[1].channels.at(Channel::lit), own};
    }
};

std::vector<std::string> namesOf(const LightingComponents& components) {
    std::vector<std::string> names;
    for (const LightingComponents::Component& each : components.components()) names.push_back(each.name);
    return names;
}

using Names = std::vector<std::string>;

TEST(LightingComponents, EqualSidesHaveNone) {
    const TermSides sides;
    EXPECT_EQ(termChannels(), termList);
    EXPECT_EQ(namesOf(sides.components()), Names{});
    EXPECT_EQ(sides.components().lit(sides.own[1], {}).data, sides.own[1].lit.data);
    EXPECT_EQ(sumOfTerms(sides.own[1].terms, *sides.own[1].emission).data, sides.own[1].lit.data);
}

// A term that only the baseline's program changes is a component, which gives the baseline's lit if taken.
TEST(LightingComponents, EachTermIsOne) {
    struct Row {
        std::size_t term;
        Channel channel;
        const char *name, *description;
        std::optional<LightChange> lights{};
    };
    const Row rows[] = {
        {0, Channel::lit_diffuse, "direct diffuse", "direct light that the diffuse lobes reflect or transmit",
         LightChange::factor},
        {1, Channel::lit_specular, "direct specular", "direct light reflected by the specular lobe",
         LightChange::factor},
        {2, Channel::lit_ambient, "ambient light", "ambient and environment light, reflected or transmitted"},
        {3, Channel::lit_haze, "haze in the air", "transmittance and scattered light of the haze"},
        {4, Channel::transmittance, "haze in the air", "transmittance and scattered light of the haze"}};
    for (const Row& row : rows) {
        TermSides sides;
        sides.baseline(row.channel).at(2, 1, 1) += 0.25f;
        sides.baseline(Channel::lit) = litOfTerms(sides.frames[0]);
        const LightingComponents found = sides.components();
        ASSERT_EQ(namesOf(found), Names{row.name});
        const LightingComponents::Component& component = found.components()[0];
        EXPECT_EQ(component.description, row.description);
        EXPECT_EQ(component.lights, row.lights) << row.name;
        Image change = ofTerms(0);
        change.at(2, 1, 1) = 0.25f;
        for (std::size_t t = 0; t < component.adds.size(); ++t)
            EXPECT_EQ(component.adds.at(t).data, t == row.term ? change.data : PixelData{}) << row.name << t;
        EXPECT_EQ(found.lit(sides.own[1], {true}).data, sides.baseline(Channel::lit).data) << row.name;
        EXPECT_EQ(found.lit(sides.own[1], {false}).data, sides.test(Channel::lit).data) << row.name;
    }
}

// A visibility scales a term by its ratio, but never by more than the term changes, nor the other way.
TEST(LightingComponents, AVisibilityHasItsPartOfDirectLight) {
    struct Row {
        float change, value, baseline, test, part;
    };
    constexpr Row rows[termPixels] = {
        {0.5f, 1, 0.5f, 0.5f, 0},           {0.5f, 1, 1, 0, 0.5f},  {0.5f, 0.25f, 1, 0.5f, 0.25f},
        {0.5f, 1, 1, 0.5f, 0.5f},           {-0.5f, 1, 1, 0.5f, 0}, {-0.5f, 1, 0.25f, 0.5f, -0.5f},
        {-0.5f, 0.5f, 0.25f, 0.5f, -0.25f}, {0, 1, 1, 0.5f, 0}};
    const std::pair<Channel, const char*> channels[] = {
        {Channel::shadow_visibility, "direct light that changes with the visibility of the sun"},
        {Channel::local_visibility,
         "direct light that changes with the visibility of point and spot lights"}};
    for (const auto& [channel, description] : channels) {
        TermSides sides;
        std::array<Image, 2> parts{ofTerms(0), ofTerms(0)}, rest = parts;
        for (std::size_t p = 0; p < termPixels; ++p) {
            const Row& row = rows[p];
            sides.baseline(channel).data[p] = row.baseline;
            sides.test(channel).data[p] = row.test;
            for (const std::size_t lobe : {0, 1}) {  // the specular one has twice of everything
                const float times = static_cast<float>(lobe + 1);
                const std::size_t i = 3 * p + lobe;
                sides.test(termList[lobe]).data[i] = times * row.value;
                sides.baseline(termList[lobe]).data[i] = times * (row.value + row.change);
                parts.at(lobe).data[i] = times * row.part;
                rest.at(lobe).data[i] = times * (row.change - row.part);
            }
        }
        for (Frame& frame : sides.frames) frame.channels[Channel::lit] = litOfTerms(frame);
        sides.light(1);
        sides.own[0] = sides.own[1];
        const LightingComponents found = sides.components();
        ASSERT_EQ(namesOf(found),
                  (Names{std::string(channel == Channel::shadow_visibility ? "shadow_visibility"
                                                                           : "local_visibility"),
                         "direct diffuse", "direct specular"}));
        const auto& all = found.components();
        EXPECT_EQ(all[0].description, description);
        EXPECT_EQ(all[0].lights, LightChange::visibility);
        for (const std::size_t lobe : {0, 1}) {
            EXPECT_EQ(all[0].adds.at(lobe).data, parts.at(lobe).data) << lobe;
            EXPECT_EQ(all[1 + lobe].adds.at(lobe).data, rest.at(lobe).data) << lobe;
        }
        EXPECT_EQ(found.lit(sides.own[1], {true, true, true}).data, sides.baseline(Channel::lit).data);
    }
}

TEST(LightingComponents, WhereOtherLightsAreEvaluatedAllDirectLightIsTheirs) {
    TermSides sides;
    sides.test(Channel::light_count).data[5] = 2;
    for (const std::size_t p : {5u, 6u})
        for (const Channel lobe : {Channel::lit_diffuse, Channel::lit_specular})
            sides.baseline(lobe).data[3 * p] += lobe == Channel::lit_diffuse ? 0.5f : 0.25f;
    sides.baseline(Channel::lit) = litOfTerms(sides.frames[0]);
    const LightingComponents found = sides.components();
    ASSERT_EQ(namesOf(found), (Names{"light_count", "direct diffuse", "direct specular"}));
    const LightingComponents::Component& lights = found.components()[0];
    EXPECT_EQ(lights.description, "direct light where the number of evaluated lights differs");
    EXPECT_EQ(lights.lights, LightChange::whole);
    Image diffuse = ofTerms(0), specular = ofTerms(0);
    diffuse.data[15] = 0.5f;
    specular.data[15] = 0.25f;
    EXPECT_EQ(LightingComponents::change(lights).diffuse.data, diffuse.data);
    EXPECT_EQ(LightingComponents::change(lights).specular.data, specular.data);
    // Direct light of the lobes that a component changes.
    const LightChannels direct{ofTerms(2), ofTerms(3)};
    EXPECT_EQ(LightingComponents::directLight(lights, direct).data, ofTerms(5).data);
    EXPECT_EQ(LightingComponents::directLight(found.components()[1], direct).data, ofTerms(2).data);
    EXPECT_EQ(LightingComponents::directLight(found.components()[2], direct).data, ofTerms(3).data);
    // A channel that one side lacks splits off nothing.
    sides.frames[0].channels.erase(Channel::light_count);
    EXPECT_EQ(namesOf(sides.components()), (Names{"direct diffuse", "direct specular"}));
}

// Light beyond the sum of the terms has a source: what stands at its pixel on either side.
TEST(LightingComponents, WhatTheTermsDoNotSumToHasASource) {
    constexpr std::size_t at = 3;
    const std::pair<const char*, const char*> background{"background",
                                                         "pixels without a surface and without blending"},
        blended{"transparency",
                "fragments blended over surfaces and background, and transmission through surfaces"},
        emitting{"sum with emission",
                 "difference between lit and the sum of its terms, only where surfaces emit"},
        other{"sum of terms",
              "difference between lit and the sum of its terms: another order or an unknown term"};
    struct Row {
        std::pair<const char*, const char*> source;
        std::array<float, 2> emission, ids;  // of baseline and test
        int blends = -1;                     // the side where our lighting blends
    };
    // A change of 0.25; half of the emission passes the haze.
    const Row rows[] = {{other, {0.25f, 0.25f}, {0, 0}},  {other, {0.499f, 0}, {0, 0}},
                        {emitting, {0.4996f, 0}, {0, 0}}, {emitting, {0, 0.4996f}, {0, -1}},
                        {background, {0, 0}, {-1, -1}},   {other, {0, 0}, {-1, 0}},
                        {other, {0, 0}, {0, -1}},         {blended, {0.5f, 0.5f}, {0, 0}, 0},
                        {blended, {0, 0}, {-1, -1}, 1}};
    for (const Row& row : rows) {
        TermSides sides;
        for (std::size_t side = 0; side < 2; ++side) {
            Frame& frame = sides.frames.at(side);
            std::ranges::fill(frame.channels[Channel::emission].data, row.emission.at(side));
            frame.channels[Channel::material_id].data[at] = row.ids.at(side);
            frame.channels[Channel::lit] = litOfTerms(frame);
            sides.light(side);
        }
        if (row.blends >= 0) sides.own.at(static_cast<std::size_t>(row.blends)).unblended.pixel(at)[2] = 9;
        sides.baseline(Channel::lit).pixel(at)[1] += 0.25f;
        const LightingComponents found = sides.components();
        ASSERT_EQ(namesOf(found), Names{row.source.first}) << row.emission[0] << row.ids[0] << row.ids[1];
        const LightingComponents::Component& component = found.components()[0];
        EXPECT_EQ(component.description, row.source.second);
        EXPECT_FALSE(component.lights.has_value());
        for (std::size_t t = 0; t < 5; ++t) EXPECT_TRUE(component.adds.at(t).empty());
        for (std::size_t i = 0; i < 3 * termPixels; ++i) {
            EXPECT_NEAR(component.adds[5].data[i], i == 3 * at + 1 ? 0.25 : 0, 1e-6);
            EXPECT_NEAR(found.lit(sides.own[1], {true}).data[i] - found.lit(sides.own[1], {false}).data[i],
                        i == 3 * at + 1 ? 0.25 : 0, 1e-6);
        }
    }
}

// Emission is no cause if over 1 % of the change is at surfaces that do not emit. Blended ones do not count.
TEST(LightingComponents, EmissionHasNearlyAllOfTheChangeOrNone) {
    for (const auto& [elsewhere, names] :
         {std::pair{0.00250f, Names{"transparency", "sum with emission", "sum of terms"}},
          {0.00256f, Names{"transparency", "sum of terms"}}}) {
        TermSides sides;
        for (Frame& frame : sides.frames) {
            Image& emission = frame.channels[Channel::emission];
            emission = ofTerms(0);
            emission.pixel(1)[0] = 4;
            frame.channels[Channel::lit] = litOfTerms(frame);
        }
        for (const std::size_t side : {0, 1}) sides.light(side);
        sides.own[1].unblended.pixel(6)[0] = 9;
        sides.baseline(Channel::lit).pixel(1)[0] -= 0.25f;
        sides.baseline(Channel::lit).pixel(2)[0] += elsewhere;
        sides.baseline(Channel::lit).pixel(6)[0] += 0.5f;
        EXPECT_EQ(namesOf(sides.components()), names) << elsewhere;
    }
}

// The test's own residual stays unless a component is taken, also on surfaces of the baseline.
TEST(LightingComponents, TakingAllGivesTheBaselinesImage) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0.1f, 1);
    TermSides sides;
    const auto fill = [&](Image& image) {
        for (float& value : image.data) value = uniform(random);
    };
    for (std::size_t side = 0; side < 2; ++side) {
        Frame& frame = sides.frames.at(side);
        for (const Channel channel : termList) fill(frame.channels[channel]);
        fill(frame.channels[Channel::emission]);
        sides.light(side);
        for (Image* const image : {&sides.own.at(side).terms.diffuse, &sides.own.at(side).terms.specular,
                                   &sides.own.at(side).terms.ambient, &sides.own.at(side).terms.haze,
                                   &sides.own.at(side).terms.transmittance, &sides.own.at(side).lit})
            fill(*image);
        fill(frame.channels[Channel::lit]);
    }
    const LightingComponents found = sides.components();
    const std::vector<bool> none(found.components().size(), false), all(found.components().size(), true);
    const Image kept = found.lit(sides.own[1], none), taken = found.lit(sides.own[0], all);
    EXPECT_EQ(kept.width, termsWide);
    EXPECT_EQ(kept.height, termsHigh);
    for (std::size_t i = 0; i < kept.data.size(); ++i) {
        EXPECT_NEAR(kept.data[i], sides.test(Channel::lit).data[i], 1e-5);
        EXPECT_NEAR(taken.data[i], sides.baseline(Channel::lit).data[i], 1e-5);
    }
}

TEST(LightingComponents, ASumIsOfSurfaces) {
    TermSides sides;
    sides.test(Channel::material_id).data[2] = -1;
    Image expected = sides.test(Channel::lit);
    std::fill_n(expected.pixel(2), 3, 0.0f);
    const Image sum = sumOfTerms(sides.frames[1]);
    EXPECT_EQ(sum.data, expected.data);
    EXPECT_EQ(sum.width, termsWide);
}

}  // namespace
}  // namespace diptych::tests
