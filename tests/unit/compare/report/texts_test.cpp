// SPDX-License-Identifier: MIT
// Rows of the table of comparisons, as they are stored: the worst channel, numbers, times, noise, the cause.
#include "compare/report/texts.h"
#include "compare/files/frame_json.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace diptych {
namespace {

constexpr double infiniteUse = std::numeric_limits<double>::infinity();

ChannelDiff usedChannel(Channel mode, Verdict verdict, double used) {
    ChannelDiff channel;
    channel.mode = &debugMode(mode);
    channel.verdict = verdict;
    channel.stats.max = used;
    channel.criterion = {.metric = "max", .measured = used, .limit = 1};
    return channel;
}

struct RowMade {
    Report report;
    Comparison& one;
    RowMade() : report(ofTwo()), one(report.comparisons[0]) {}
    static Report ofTwo() {
        Report report;
        report.device.name = "a CPU";
        report.frames.resize(2);
        report.comparisons.emplace_back().test = 1;
        return report;
    }
    IndexRow row() const { return indexRowOf(report, one); }
};

// Failing ones first; channels whose every pixel has a limit only if they fail; the first of equals.
TEST(ReportRows, TheWorstChannelUsesMostOfItsLimit) {
    RowMade made;
    const auto worst = [&] {
        const IndexRow row = made.row();
        return row.worst ? std::string(row.worst->name) : "none";
    };
    auto& all = made.one.channels;
    EXPECT_EQ(worst(), "none");
    all = {usedChannel(Channel::texcoords, Verdict::forward_only, 9)};
    EXPECT_EQ(worst(), "none");
    all.push_back(usedChannel(Channel::roughness, Verdict::pass, 0.5));
    all.push_back(usedChannel(Channel::metallic, Verdict::pass, 0.5));
    EXPECT_EQ(worst(), "roughness");
    all.push_back(usedChannel(Channel::occlusion, Verdict::pass, 0.75));
    EXPECT_EQ(worst(), "occlusion");
    EXPECT_EQ(made.row().used, 0.75);
    all.push_back(usedChannel(Channel::lit, Verdict::pass, 0.875));
    all.back().unexplained_pixels = 0;
    EXPECT_EQ(worst(), "occlusion");
    all.back().verdict = Verdict::fail;
    all.back().stats.max = 0.25;
    all.back().criterion->measured = 0.25;
    EXPECT_EQ(worst(), "lit") << "it fails";
    all.push_back(usedChannel(Channel::albedo, Verdict::fail, 4));
    EXPECT_EQ(worst(), "albedo");
    all.back().criterion->limit = 0;
    EXPECT_EQ(made.row().used, 1e300) << "infinity";
}

TEST(ReportRows, AreStoredWhole) {
    RowMade made;
    Frame &left = made.report.frames[0], &right = made.report.frames[1];
    left.scene = "a scene";
    left.name = "left";
    right.name = "right";
    left.camera.fov_degrees = 30;
    left.time = {.median = 1.5, .min = 1, .max = 2, .runs = 1};
    right.time.median = 2.5;
    left.noise[Channel::roughness] = {1, 0.25};
    right.noise[Channel::roughness] = {1, 0.125};
    right.noise[Channel::lit] = {1, infiniteUse};
    ChannelDiff rough = usedChannel(Channel::roughness, Verdict::fail, 2),
                lit = usedChannel(Channel::lit, Verdict::pass, 0);
    rough.stats = {.max = 2, .mean = 3, .rmse = 4, .p99 = 5, .p999 = 6};
    rough.flip = 7;
    lit.stats = {.max = infiniteUse,
                 .mean = infiniteUse,
                 .rmse = infiniteUse,
                 .p99 = infiniteUse,
                 .p999 = infiniteUse};
    lit.verdict = Verdict::informative;
    lit.criterion = {.metric = "max", .measured = 1, .limit = 0};
    made.one.channels = {lit, rough, usedChannel(Channel::texcoords, Verdict::forward_only, 1)};
    made.one.explained = Explained{{}, R"({"causes": [{"name": "shadows"}, {"name": "other"}]})", {}};
    const nlohmann::ordered_json json = jsonOf(made.row());
    const std::string camera = nlohmann::json(jsonOf(left.camera).dump()).dump();
    EXPECT_EQ(
        json.dump(),
        R"({"worst":4,"used":2.0,"ms":[1.5,2.5],"timed":[true,false],"cause":"shadows","device":"a CPU",)"
        R"("key":"a scene\nleft\nright\n)" +
            camera.substr(1) +
            R"(,"channels":[["lit","informative",1e+300,1e+300,1e+300,1e+300,1e+300,1e+300,-1.0,1e+300],)"
            R"(["roughness","fail",2.0,2.0,3.0,4.0,5.0,6.0,7.0,0.375]]})");
    const nlohmann::json stored = nlohmann::json::parse(json.dump());
    EXPECT_EQ(jsonOf(indexRowFrom(JsonAt(stored))).dump(), json.dump()) << "and read back";
    right.time.runs = 1;
    left.time.runs = 0;
    EXPECT_EQ(jsonOf(made.row())["timed"].dump(), "[false,true]");
    for (const char* none : {"[]", R"({"causes": []})", R"({"other": 1})", R"({"causes": [{"share": 1}]})"}) {
        made.one.explained = Explained{{}, none, {}};
        EXPECT_EQ(made.row().cause, "") << none;
    }
    made.one.explained.reset();
    made.one.channels.clear();
    EXPECT_EQ(made.row().cause, "");
    EXPECT_EQ(jsonOf(made.row())["worst"].dump(), "null");
}

TEST(ReportRows, ChannelsAreReadByTheirIndex) {
    const auto fault = [](const nlohmann::json& index) {
        return faultOf([&] { debugModeFrom(JsonAt(index, "worst")); });
    };
    EXPECT_EQ(debugModeFrom(JsonAt(nlohmann::json(4))).name, "roughness");
    EXPECT_EQ(debugModeFrom(JsonAt(nlohmann::json(0))).name, "lit");
    EXPECT_EQ(fault(13), "worst: is not a channel index");
    EXPECT_EQ(fault(1 << 20), "worst: is not a channel index");
    const std::string whole = "worst: is not a whole number from 0 to 1048576";
    EXPECT_EQ(fault((1 << 20) + 1), whole);
    EXPECT_EQ(fault(-1), whole);
}

TEST(ReportRows, TheDeviceHasItsTimes) {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    report.comparisons.resize(3);
    report.diff_ms = 1.5;
    ReportLayout layout;
    layout.encode_ms = 2.5;
    for (const ReportLayout* of : {&layout, static_cast<ReportLayout*>(nullptr)}) {
        const DrawnOn drawn = drawnOn(report, of);
        EXPECT_EQ(drawn.device.driver, "1.0");
        EXPECT_EQ(drawn.comparisons, 3u);
        EXPECT_EQ(drawn.compare_ms, 1.5);
        EXPECT_EQ(drawn.encode_ms, of ? 2.5 : 0);
    }
}

}  // namespace
}  // namespace diptych
