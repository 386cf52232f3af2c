// SPDX-License-Identifier: MIT
// Against the reference, a thousandth of the pixels may be out of tolerance, and not one more. Between the
// paths none may.
#include "compare/verdict/comparison.h"
#include "tests/support/frames.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

constexpr std::size_t fractionWide = 50, fractionHigh = 50,
                      fractionCovered = 2000;  // the others are background

Frame fractionFrame(Path path, std::size_t wrong) {
    Frame frame = flatFrame(path, fractionWide, fractionHigh, 1, -1);
    std::fill_n(frame.channels[Channel::material_id].data.begin(), fractionCovered, 3.0f);
    for (std::size_t i = 0; i < wrong; ++i) frame.channels[Channel::lit].pixel(7 * i)[1] = 2;
    for (std::size_t i = fractionCovered; i < fractionWide * fractionHigh; ++i)
        frame.channels[Channel::lit].pixel(i)[0] = path == Path::reference ? 1.0f : 9.0f;
    return frame;
}

Verdict litVerdict(Path left, Path right, std::size_t wrong) {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    report.frames = {fractionFrame(left, 0), fractionFrame(right, wrong)};
    const Comparison comparison = compareFrames(report, 0, 1, {}, {});
    for (const ChannelDiff& channel : comparison.channels)
        if (channel.mode->channel == Channel::lit) return channel.verdict;
    throw std::runtime_error("no lit");
}

TEST(ComparisonShare, OneInAThousandOfTheCoveredPixelsMayBeBeyond) {
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        EXPECT_EQ(litVerdict(Path::reference, path, 0), Verdict::pass);
        EXPECT_EQ(litVerdict(Path::reference, path, 2), Verdict::pass) << "2 of 2000";
        EXPECT_EQ(litVerdict(Path::reference, path, 3), Verdict::fail) << "of 2500 it would be 0.12 %";
    }
    EXPECT_EQ(litVerdict(Path::deferred, Path::forward_plus, 0), Verdict::pass);
    EXPECT_EQ(litVerdict(Path::deferred, Path::forward_plus, 1), Verdict::fail);
}

}  // namespace
}  // namespace diptych
