// SPDX-License-Identifier: MIT
// The page's table of channels: what a limit is on, and how much of the picture is beyond it.
#include "compare/report/report.h"
#include "tests/unit/files.h"
#include "tests/unit/report_maker.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

// The row of roughness, of which one covered pixel is all and differs by 0.25.
std::string rowOfRoughness(bool mostPixels) {
    std::vector<Frame> frames = bothFrames();
    frames[1].channels[gpu::DEBUG_roughness].at(1, 2) = 0.75f;
    Report report = reportOf(std::move(frames));
    for (ChannelDiff& channel : report.comparisons[0].channels) channel.tolerance.most_pixels = mostPixels;
    const std::filesystem::path out = folder() / "report";
    writeReport(report, out, {});
    const std::string page = contentsOf(out / "index.html");
    const std::size_t row = page.find("<tr><td><a href=\"#c0-roughness\">");
    return page.substr(row, page.find("</tr>", row) - row);
}

TEST(ReportOverview, ALimitIsOnAFigureAndAFailureHasItsShare) {
    const std::string largest = rowOfRoughness(false), most = rowOfRoughness(true);
    EXPECT_NE(largest.find("<td class=\"soft\">max</td>"), std::string::npos) << largest;
    EXPECT_NE(most.find("<td class=\"soft\">p99.9</td>"), std::string::npos) << most;
    EXPECT_NE(largest.find("<span class=\"beyond\">100 % of the pixels</span>"), std::string::npos)
        << largest;
    // On a narrow page stays the figure that is judged.
    EXPECT_NE(largest.find("<td class=\"n\">0.25</td><td class=\"n optional\">"), std::string::npos)
        << largest;
    EXPECT_NE(most.find("<td class=\"n optional\">0.25</td><td class=\"n optional\">"), std::string::npos)
        << most;
}

}  // namespace
}  // namespace diptych
