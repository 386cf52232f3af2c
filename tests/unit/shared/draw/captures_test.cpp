// SPDX-License-Identifier: MIT
#include "shared/draw/captures.h"

#include "shared/frame/debug_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace diptych {
namespace {

constexpr VkFormat of_lit = VK_FORMAT_B10G11R11_UFLOAT_PACK32, of_others = VK_FORMAT_R32G32B32A32_SFLOAT;

std::vector<Channel> everyMode() {
    std::vector<Channel> modes;
    for (const DebugMode& mode : debugModes()) modes.push_back(mode.channel);
    return modes;
}

// No two channels share a component, none is truncated, and channels of light are in the last images.
TEST(Captures, EachChannelHasComponentsOfItsOwn) {
    std::map<std::pair<gpu::uint, gpu::uint>, Channel> taken;
    for (const DebugMode& mode : debugModes()) {
        const auto [image, component] = captureIndex(mode.channel);
        ASSERT_LT(image, gpu::CAPTURE_IMAGES) << mode.name;
        EXPECT_LE(component + static_cast<gpu::uint>(mode.width), 4u) << mode.name;
        EXPECT_EQ(image >= gpu::FIRST_LIT_IMAGE, isShaded(mode.channel)) << mode.name;
        for (gpu::uint c = component; c < component + static_cast<gpu::uint>(mode.width); ++c)
            EXPECT_EQ(taken.emplace(std::pair{image, c}, mode.channel).first->second, mode.channel)
                << mode.name;
    }
    for (const Channel mode : {Channel::lit, Channel::shaded_samples})
        for (const Channel other : everyMode()) {
            if (other == mode) continue;
            EXPECT_NE(captureIndex(other).image, captureIndex(mode).image) << debugMode(other).name;
        }
    EXPECT_THROW(captureIndex(foreignChannel(0)), std::out_of_range);
}

// Every requested channel once, images in order; light in as few passes as possible.
TEST(Captures, PassesHoldWhatIsAskedFor) {
    for (const std::size_t max : {std::size_t{8}, std::size_t{4}}) {
        const auto groups = captureGroups(everyMode(), of_lit, max);
        EXPECT_EQ(groups.size(), max == 8 ? 5u : 8u);
        std::vector<Channel> modes;
        gpu::uint all = 0;
        for (const CaptureGroup& group : groups) {
            EXPECT_LE(group.formats.size(), max);
            EXPECT_EQ(group.formats.size(), static_cast<std::size_t>(std::popcount(group.images)));
            EXPECT_GT(group.images, all) << "in the order of images";
            EXPECT_EQ(group.images & all, 0u) << "an image is drawn twice";
            all |= group.images;
            modes.insert(modes.end(), group.modes.begin(), group.modes.end());
        }
        std::ranges::sort(modes);
        EXPECT_EQ(modes, everyMode());
        EXPECT_EQ(all, (1u << gpu::CAPTURE_IMAGES) - 1);
        const auto shading = std::ranges::count_if(
            groups, [](const CaptureGroup& group) { return group.images >> gpu::FIRST_LIT_IMAGE != 0; });
        EXPECT_EQ(shading, max == 8 ? 2 : 3);
    }
}

TEST(Captures, LightIsBesideSurfacesWhereItFits) {
    const auto groups = captureGroups(std::vector{Channel::lit, Channel::metallic, Channel::albedo}, of_lit);
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_EQ(groups[0].modes, (std::vector{Channel::albedo, Channel::metallic, Channel::lit}));
    EXPECT_EQ(groups[0].formats, (std::vector{of_others, of_lit}));
    EXPECT_TRUE(captureGroups({}, of_lit).empty());
}

TEST(Captures, TheSunsShadowAloneNeedsNoLight) {
    const std::vector shadow{Channel::depth, Channel::shadow_visibility};
    const auto alone = captureGroups(shadow, of_lit);
    ASSERT_EQ(alone.size(), 1u);
    EXPECT_EQ(alone[0].feature(), alone[0].images | gpu::CAPTURES_UNLIT);
    for (const Channel other : {Channel::lit_diffuse, Channel::local_visibility, Channel::lit}) {
        const auto lit = captureGroups(std::vector{Channel::shadow_visibility, other}, of_lit);
        for (const CaptureGroup& group : lit) EXPECT_EQ(group.feature(), group.images);
    }
    for (const CaptureGroup& group : captureGroups(std::vector{Channel::depth}, of_lit))
        EXPECT_EQ(group.feature(), group.images);
}

}  // namespace
}  // namespace diptych
