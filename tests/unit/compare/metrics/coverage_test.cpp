// SPDX-License-Identifier: MIT
// Which pixels count.
#include "compare/metrics/channel.h"
#include "shared/contract/debug_mode.h"
#include "tests/support/errors.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace diptych {
namespace {

Frame ids(PixelData values) {
    Frame frame;
    frame.settings.size = {static_cast<int>(values.size()), 1};
    frame.channels[Channel::material_id] = rowOf(1, std::move(values));
    return frame;
}

TEST(Coverage, APixelIsBackgroundOnlyInBoth) {
    const Coverage c = coverage(ids({-1, -1, 0, 3}), ids({-1, 2, -1, 3}));
    EXPECT_EQ(c.covered, (std::vector<std::uint8_t>{0, 1, 1, 1}));
    EXPECT_EQ(c.count, 3u);
    EXPECT_TRUE(c.known);
}

TEST(Coverage, DepthTellsWhereThereAreNoIds) {
    Frame frame;
    frame.settings.size = {2, 1};
    frame.channels[Channel::depth] = rowOf(1, {0, 5});
    EXPECT_EQ(coverage(frame, frame).covered, (std::vector<std::uint8_t>{0, 1}));
    Frame bare;
    bare.settings.size = {2, 1};
    bare.channels[Channel::lit] = rowOf(3, {0, 0, 0, 1, 1, 1});
    EXPECT_FALSE(coverage(bare, bare).known);
    EXPECT_EQ(coverage(bare, bare).count, 2u);
}

TEST(Coverage, AChannelOfAnotherSizeIsAnError) {
    Frame frame = ids({0, 1});
    frame.channels[Channel::depth] = rowOf(1, {0, 5, 6});
    EXPECT_THROW(coverage(frame, frame), std::runtime_error);
}

TEST(Coverage, BackgroundIsOutsideMeansAndErrors) {
    const Coverage c = coverage(ids({-1, 1}), ids({-1, 1}));
    const Image baseline = rowOf(1, {0, 1}), test = rowOf(1, {7, 1.5f});  // 7: background, must not count
    EXPECT_EQ(channelStats(ErrorKind::absolute, ChannelKind::scalar, baseline, test, c).mean, 0.5);
    const Image errors = errorImage(ErrorKind::absolute, ChannelKind::scalar, baseline, test, c);
    EXPECT_EQ(errors.data, (PixelData{0, 0.5f}));
}

TEST(Coverage, BlackAndLitAreOfCoveredPixels) {
    Image image(2, 2, 3);
    const Coverage all = everyPixel(4), upper{{1, 1, 0, 0}, 2, true}, none{{0, 0, 0, 0}, 0, true};
    EXPECT_FALSE(all.known);
    EXPECT_TRUE(isBlack(image, all));
    EXPECT_EQ(litFraction(image, all), 0);
    image.at(1, 1, 2) = -1;
    EXPECT_FALSE(isBlack(image, all));
    EXPECT_TRUE(isBlack(image, upper));
    EXPECT_EQ(litFraction(image, all), 0.25);
    EXPECT_EQ(litFraction(image, upper), 0);
    image.at(1, 0, 0) = 1;
    EXPECT_FALSE(isBlack(image, upper));
    EXPECT_EQ(litFraction(image, upper), 0.5);
    EXPECT_EQ(litFraction(image, none), 0);
    EXPECT_TRUE(isBlack(image, none));
}

// Blended surfaces stand before the background: by their count, or where lit differs from what is behind.
TEST(Coverage, ABlendedSurfaceIsASurface) {
    const Frame bare = ids({-1, -1, -1, 0});
    Frame blended = bare;
    blended.blended = rowOf(1, {0, 0.25f, 0, 0});
    using Covered = std::vector<std::uint8_t>;
    EXPECT_EQ(coverage(blended, bare).covered, (Covered{0, 1, 0, 1}));
    EXPECT_EQ(coverage(bare, blended).covered, (Covered{0, 1, 0, 1}));
    EXPECT_EQ(coverage(bare, blended).count, 2u);
    Frame seen = bare;
    seen.channels[Channel::lit] = seen.unblended = Image(4, 1, 3, 0.5f);
    EXPECT_EQ(coverage(seen, bare).covered, (Covered{0, 0, 0, 1}));
    seen.unblended.at(2, 0, 2) = 0;
    EXPECT_EQ(coverage(seen, bare).covered, (Covered{0, 0, 1, 1}));
    seen.blended = rowOf(1, {0, 0, 0, 0});
    EXPECT_EQ(coverage(seen, bare).covered, (Covered{0, 0, 0, 1})) << "the count is known";
}

// Ids before depths, if both Frames have them.
TEST(Coverage, BothFramesNeedTheChannel) {
    Frame with = ids({-1, 2}), without;
    with.channels[Channel::depth] = rowOf(1, {5, 0});
    EXPECT_EQ(coverage(with, with).covered, (std::vector<std::uint8_t>{0, 1}));
    without.settings.size = {2, 1};
    without.channels[Channel::depth] = rowOf(1, {5, 0});
    EXPECT_EQ(coverage(with, without).covered, (std::vector<std::uint8_t>{1, 0}));
    EXPECT_EQ(coverage(without, with).covered, (std::vector<std::uint8_t>{1, 0}));
    EXPECT_EQ(coverage(Frame(), Frame()).count, 0u);
    Frame wrong = without;
    wrong.name = "deferred";
    wrong.settings.size = {2, 3};
    EXPECT_EQ(faultOf([&] { coverage(without, wrong); }), "deferred: depth is 2x1 in a Frame of 2x3");
    wrong.settings.size = {3, 1};
    EXPECT_EQ(faultOf([&] { coverage(wrong, without); }), "deferred: depth is 2x1 in a Frame of 3x1");
}

}  // namespace
}  // namespace diptych
