// SPDX-License-Identifier: MIT
// MSAA paths against the reference: only lit has the same meaning in both.
#include "shared/frame/supported_channels.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

// The reference in mode scene and both paths with this number of samples. In channels other than lit and
// ids the paths differ from the reference.
std::vector<Frame> sampledFrames(int samples) {
    std::vector<Frame> frames = bothFrames();
    Frame reference = frames[1];
    reference.name = "reference";
    reference.settings.path = Path::reference;
    reference.settings.reference_mode = ReferenceMode::scene;
    reference.settings.spp = 64;
    reference.through_gbuffer.clear();
    std::erase_if(reference.channels,
                  [](const auto& channel) { return !isSupportedByReference(debugMode(channel.first)); });
    for (Frame& frame : frames) {
        frame.settings.msaa = samples;
        for (auto& [mode, image] : frame.channels) {
            if (mode == Channel::lit || debugMode(mode).kind == ChannelKind::id) continue;
            for (int c = 0; c < image.components; ++c) image.at(1, 2, c) = 0.577f;
        }
    }
    frames.insert(frames.begin(), reference);
    return frames;
}

Report against(std::vector<Frame> frames) {
    return makeReport({{std::move(frames)}}, {"a CPU", "1.0", "cpu"});
}

TEST(SampledComparison, IsOfLitAlone) {
    const Report report = against(sampledFrames(4));
    ASSERT_EQ(report.comparisons.size(), 3u);
    for (const std::size_t i : {0u, 1u}) {
        const Comparison& comparison = report.comparisons[i];
        ASSERT_EQ(comparison.channels.size(), 1u);
        EXPECT_EQ(comparison.channels[0].mode->name, "lit");
        EXPECT_TRUE(comparison.passed()) << (comparison.failures.empty() ? "" : comparison.failures[0]);
        EXPECT_EQ(std::ranges::count_if(
                      comparison.notes,
                      [](const std::string& note) { return note.starts_with("only lit is compared"); }),
                  1);
    }
    EXPECT_GT(report.comparisons[2].channels.size(), 10u) << "the paths' samples are the same ones";
    const Report single = against(sampledFrames(1));
    EXPECT_GT(single.comparisons[0].channels.size(), 10u);
    EXPECT_FALSE(single.comparisons[0].passed());
}

TEST(SampledComparison, FindsWhereLitIsWrong) {
    std::vector<Frame> frames = sampledFrames(4);
    frames[2].channels[Channel::lit].at(1, 2, 1) = std::numeric_limits<float>::quiet_NaN();
    const Report report = against(std::move(frames));
    EXPECT_TRUE(report.comparisons[0].passed());
    EXPECT_FALSE(report.comparisons[1].passed());
}

TEST(SampledComparison, WithoutLitThereIsNothingToCompare) {
    std::vector<Frame> frames = sampledFrames(4);
    for (Frame& frame : frames) frame.channels.erase(Channel::lit);
    EXPECT_THROW(against(std::move(frames)), std::runtime_error);
}

}  // namespace
}  // namespace diptych
