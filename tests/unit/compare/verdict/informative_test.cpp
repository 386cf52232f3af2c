// SPDX-License-Identifier: MIT
// Paths with Settings of their own: if these change light, channels of light do not affect the verdict.
#include "compare/report/json.h"
#include "compare/report/parts.h"
#include "compare/report/titles.h"
#include "shared/frame/sides.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

// Both paths, forward+ with lights per object, and `wrong` channels that differ.
Report informedReport(const std::vector<Channel>& wrong, std::vector<Rule> rules = {}, bool told = true) {
    std::vector<Frame> frames = bothFrames();
    frames[1].settings.assign = Assignment::per_object;
    for (const Channel mode : wrong) frames[1].channels.at(mode).at(1, 2, 0) += 0.25f;
    CompareOptions options;
    options.rules = std::move(rules);
    if (told) options.light_differs = lightDifferences(frames[0].settings, frames[1].settings);
    return makeReport({{std::move(frames)}}, {"a CPU", "1.0", "cpu"}, options);
}

const ChannelDiff& informedChannel(const Report& report, Channel mode) {
    for (const ChannelDiff& channel : report.comparisons[0].channels)
        if (channel.mode->channel == mode) return channel;
    throw std::out_of_range("no such channel");
}

TEST(Informative, LightDecidesNothingAndSurfacesDo) {
    const Report light = informedReport({Channel::lit, Channel::lit_specular, Channel::shadow_visibility});
    EXPECT_TRUE(light.passed()) << verdictLine(light);
    for (const Channel mode : {Channel::lit, Channel::lit_ambient, Channel::shadow_visibility})
        EXPECT_EQ(informedChannel(light, mode).verdict, Verdict::informative);
    EXPECT_EQ(informedChannel(light, Channel::albedo).verdict, Verdict::pass);
    EXPECT_GT(informedChannel(light, Channel::lit).stats.max, 0.1) << "but it is measured";
    EXPECT_FALSE(informedReport({Channel::albedo}).passed());
    EXPECT_FALSE(informedReport({Channel::shadow_visibility}, {}, false).passed()) << "without being told";
    // An impossible value is a fault in any comparison.
    EXPECT_FALSE(
        informedReport({Channel::transmittance, Channel::transmittance, Channel::transmittance}).passed());
}

TEST(Informative, ARuleForLitEvaluatesIt) {
    const std::vector<Rule> rules =
        rulesFromJson(R"({ "rules": [ { "channel": "lit", "max": 0.01, "because": "close" } ] })", "r.json");
    EXPECT_TRUE(informedReport({}, rules).passed());
    EXPECT_EQ(informedChannel(informedReport({}, rules), Channel::lit).verdict, Verdict::pass);
    EXPECT_FALSE(informedReport({Channel::lit}, rules).passed());
}

TEST(Informative, TheReportSaysWhatDiffers) {
    const Report report = informedReport({Channel::lit});
    EXPECT_EQ(verdictLine(report),
              "pass: all 32 compared channels are within tolerance; 12 channels of light not counted: the "
              "paths' Settings differ (4 more exist on one side only)");
    const std::string said =
        "deferred and forward_plus have different Settings: --assign clustered and per_object";
    EXPECT_EQ(countOf(reportTable(report), said), 1u) << reportTable(report);
    const auto json = nlohmann::json::parse(reportJson(report, nullptr));
    const auto& comparison = json["comparisons"][0];
    EXPECT_EQ(comparison["differing_settings"], (nlohmann::json{{"assign", {"clustered", "per_object"}}}));
    for (const auto& channel : comparison["channels"])
        if (channel["name"] == "lit") {
            EXPECT_EQ(channel["verdict"], "informative");
            EXPECT_NE(std::string(channel["because"]).find("--assign clustered and per_object"),
                      std::string::npos);
        }
    EXPECT_EQ(nlohmann::json::parse(
                  reportJson(reportOf(bothFrames()), nullptr))["comparisons"][0]["differing_settings"],
              nlohmann::json::object());
}

}  // namespace
}  // namespace diptych
