// SPDX-License-Identifier: MIT
// Settings for one path only: --deferred and --forward-plus.
#include "shared/frame/sides.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

constexpr Path leftSide = drawn_paths[0], rightSide = drawn_paths[1];

std::string sidesRefused(const std::string& left, const std::string& right) {
    Settings common;
    return faultOf([&] { readSides({left, right}, common); });
}

TEST(Sides, EachPathHasItsOwnOnTopOfTheCommonOnes) {
    Settings common;
    common.shadows = Shadows::evsm;
    const SideSettings sides = readSides({"ambient=1,0,0.5", "assign=per_object,pixel-lights=2"}, common);
    const Settings left = sides.of(common, leftSide), right = sides.of(common, rightSide);
    EXPECT_EQ(left.path, leftSide);
    EXPECT_EQ(left.ambient, (Rgb{1, 0, 0.5f})) << "commas belong to the value";
    EXPECT_EQ(left.assign, Assignment::clustered);
    EXPECT_EQ(right.assign, Assignment::per_object);
    EXPECT_EQ(right.pixel_lights, 2);
    EXPECT_EQ(right.ambient, Rgb());
    EXPECT_EQ(right.shadows, Shadows::evsm);
    EXPECT_FALSE(left.problem() || right.problem());
    EXPECT_EQ(sides.of(common, Path::reference).assign, Assignment::clustered);
    // The words are complete: they mean the same with any common Settings.
    EXPECT_EQ(wordsOf(sides),
              (std::vector<std::string>{"--deferred", "ambient=1,0,0.5,assign=clustered,pixel-lights=4",
                                        "--forward-plus", "ambient=0,0,0,assign=per_object,pixel-lights=2"}));
    Settings other = right;
    EXPECT_EQ(readSides({wordsOf(sides)[1], wordsOf(sides)[3]}, other).of(other, leftSide), left);
    EXPECT_FALSE(readSides({"", ""}, common).any());
    EXPECT_TRUE(wordsOf(SideSettings()).empty());
}

// Both paths are judged with the same G-buffer encoding.
TEST(Sides, WhatOnlyOnePathReadsIsSetForBoth) {
    Settings common;
    const SideSettings sides = readSides({"gbuffer=compact,shadows=off", "prepass=on"}, common);
    EXPECT_EQ(common.gbuffer, GBufferEncoding::compact);
    EXPECT_EQ(common.prepass, Switch::on);
    EXPECT_EQ(wordsOf(sides),
              (std::vector<std::string>{"--deferred", "shadows=off", "--forward-plus", "shadows=pcf"}));
}

TEST(Sides, AreRefusedInOneLineThatHelps) {
    EXPECT_EQ(sidesRefused("gbufer=compact", ""),
              "--deferred gbufer=compact: there is no Setting gbufer; did you mean gbuffer?");
    EXPECT_EQ(sidesRefused("", "size=8x8"),
              "--forward-plus size=8x8: both paths show one view of one scene; use --size, which sets both");
    EXPECT_EQ(
        sidesRefused("variant=red", ""),
        "--deferred variant=red: both paths show one view of one scene; use --variant, which sets both");
    EXPECT_EQ(
        sidesRefused("", "gbuffer=compact"),
        "--forward-plus gbuffer=compact: forward_plus has no G-buffer; --deferred gbuffer=compact sets it");
    EXPECT_EQ(sidesRefused("spp=4", ""),
              "--deferred spp=4: only the reference takes several samples of a surface");
    EXPECT_EQ(sidesRefused("path=reference", ""),
              "--deferred path=reference: the option already selects the path");
    EXPECT_EQ(sidesRefused("every", ""), "--deferred every: takes NAME=VALUE,..., for example assign=every");
    EXPECT_EQ(sidesRefused("assign=every,assign=tiled", ""),
              "--deferred assign=every,assign=tiled: assign is given twice");
    EXPECT_NE(sidesRefused("", "assign=evry").find("--assign evry: not "), std::string::npos);
    for (const std::string_view option : viewOptions()) settingField(option);  // throws if there is none
}

TEST(Sides, TellWhatChangesLight) {
    const auto changed = [](const std::string& left, const std::string& right) {
        Settings common;
        const SideSettings sides = readSides({left, right}, common);
        return lightDifferences(sides.of(common, leftSide), sides.of(common, rightSide));
    };
    EXPECT_EQ(changed("assign=every,light-kernel=gather,cull=off", "assign=tiled,skinning=vertex"), "");
    EXPECT_EQ(changed("", "assign=per_object,pixel-lights=8"),
              "--assign clustered and per_object, --pixel-lights 4 and 8");
    EXPECT_EQ(changed("shadows=evsm", "shadows=evsm"), "") << "both have it";
    EXPECT_EQ(changed("shadows=evsm", ""), "--shadows evsm and pcf");
    Settings left, right;
    left.path = leftSide;
    left.prepass = Switch::on;
    right.cull = false;
    const std::vector<SettingDifference> all = settingDifferences(left, right);
    ASSERT_EQ(all.size(), 1u) << "deferred has no depth pre-pass";
    EXPECT_EQ(describe(all), "--cull on and off");
}

}  // namespace
}  // namespace diptych
