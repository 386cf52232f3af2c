// SPDX-License-Identifier: MIT
// Savings and changes from deferred lighting's sample groups, per row of a sweep.
#include "compare/output/writers.h"
#include "compare/tradeoff/captured_errors.h"
#include "compare/tradeoff/tables.h"
#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace diptych::tradeoff {
namespace {

Frame sampledRow(const std::vector<float>& lit, const std::vector<float>& shaded) {
    Frame frame;
    const auto image = [](const std::vector<float>& values) {
        Image row(static_cast<int>(values.size()), 1, 1);
        row.data.assign(values.begin(), values.end());
        return row;
    };
    frame.channels[Channel::lit] = image(lit);
    frame.channels[Channel::shaded_samples] = image(shaded);
    return frame;
}

TEST(TradeoffSamples, AreFractionsOfThePixelsThatShowASurface) {
    const Frame exact = sampledRow({1, 2, 3, 4, 0}, {1, 4, 2, 1, 0});
    EXPECT_EQ(sampleFractionsOf(exact, exact), (SampleFractions{8.0 / 4, 0.5, 0, 0}));
    // The second pixel differs with fewer shaded samples, the fourth with the same number.
    const Frame similar = sampledRow({1, 2.5f, 3, 5, 9}, {1, 2, 2, 1, 0});
    EXPECT_EQ(sampleFractionsOf(exact, similar), (SampleFractions{6.0 / 4, 0.5, 0.5, 0.25}));
    const Frame background = sampledRow({0}, {0});
    EXPECT_EQ(sampleFractionsOf(background, background), SampleFractions{});
    Frame without = exact;
    without.channels.erase(Channel::shaded_samples);
    EXPECT_FALSE(sampleFractionsOf(exact, without));
}

TEST(TradeoffSamples, DeferredAloneChoosesThem) {
    Settings settings;
    settings.path = Path::deferred;
    EXPECT_FALSE(exactEdges(settings));
    settings.msaa = 4;
    settings.msaa_edges = MsaaEdges::similar;
    ASSERT_TRUE(exactEdges(settings));
    EXPECT_EQ(exactEdges(settings)->msaa_edges, MsaaEdges::exact);
    settings.path = Path::forward_plus;
    EXPECT_FALSE(exactEdges(settings));
}

TEST(TradeoffSamples, TheTableHasTheRowsThatChoose) {
    Tradeoff tradeoff;
    tradeoff.requested.path = Path::deferred;
    tradeoff.requested.msaa = 4;
    EXPECT_TRUE(sampleBlocks(tradeoff).empty());
    for (const MsaaEdges edges : {MsaaEdges::exact, MsaaEdges::similar}) {
        TradeoffRow row;
        row.settings = tradeoff.requested;
        row.settings.msaa_edges = edges;
        row.measured.set(FrameTime{12, 11, 13, 5});
        if (edges == MsaaEdges::similar)
            row.measured.set(Measure::shaded, SampleFractions{1.25, 0.125, 0.0625, 0});
        tradeoff.rows.push_back(row);
    }
    const std::string text = inText(sampleBlocks(tradeoff)), html = inHtml(sampleBlocks(tradeoff));
    EXPECT_NE(text.find("   2        12"), std::string::npos) << text;
    EXPECT_NE(text.find("1.25"), std::string::npos) << text;
    EXPECT_NE(text.find("msaa-edges similar"), std::string::npos) << text;
    EXPECT_EQ(text.find("\n   1 "), std::string::npos) << text;
    EXPECT_NE(html.find("<tr data-row=\"2\">"), std::string::npos) << html;
    const TradeoffRow again = tradeoffRowFrom(jsonOf(tradeoff.rows[1]));
    EXPECT_EQ(again[Measure::edges], 0.125);
    EXPECT_FALSE(tradeoffRowFrom(jsonOf(tradeoff.rows[0])).measured.has(Measure::shaded));
}

}  // namespace
}  // namespace diptych::tradeoff
