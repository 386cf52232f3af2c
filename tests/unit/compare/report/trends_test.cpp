// SPDX-License-Identifier: MIT
// Changes since an earlier report: their kinds, the noise that hides them, lines and JSON.
#include "compare/report/trends.h"
#include "compare/report/json.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

constexpr double endlessError = std::numeric_limits<double>::infinity();

// A comparison of roughness; its errors are fractions of the largest one. It fails above 1.
struct Scored {
    std::string scene;
    double max = 0;
    std::string camera{};
};

ChannelStats statsUpTo(double top) {
    ChannelStats stats;
    stats.max = top;
    stats.mean = top / 2;
    stats.rmse = top * 3 / 4;
    stats.p99 = top * 7 / 8;
    stats.p999 = top * 15 / 16;
    return stats;
}

Report scored(const std::vector<Scored>& all) {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    for (const Scored& of : all) {
        Comparison& one = report.comparisons.emplace_back();
        one.baseline = report.frames.size();
        one.test = one.baseline + 1;
        for (const char* name : {"deferred", "forward_plus"}) {
            Frame& frame = report.frames.emplace_back();
            frame.name = name;
            frame.scene = of.scene;
            frame.settings.size = {4, 3};
            frame.camera.name = of.camera;
        }
        ChannelDiff& channel = one.channels.emplace_back();
        channel.mode = &debugMode(Channel::roughness);
        channel.stats = statsUpTo(of.max);
        channel.verdict = of.max > 1 ? Verdict::fail : Verdict::pass;
    }
    return report;
}

fs::path written(const Report& earlier) {
    const fs::path here = folder();
    std::ofstream(here / "report.json") << reportJson(earlier, nullptr);
    return here;
}

Trends trendsOf(const Report& earlier, const Report& now) {
    std::vector<IndexRow> rows;
    for (const Comparison& comparison : now.comparisons) rows.push_back(indexRowOf(now, comparison));
    return trendsSince(written(earlier), now, rows);
}
Lines linesOf(const Report& earlier, const Report& now) {
    return trendLines(trendsOf(earlier, now), now);
}

TEST(Trends, EachKindHasItsLineAndItsJson) {
    const Report earlier = scored({{"a", 0.5}, {"b", 2}, {"c", 0.25}, {"d", 0.25}, {"e", 2}, {"old", 0}}),
                 now = scored({{"a", 2}, {"b", 0.5}, {"c", 0.25}, {"d", 0.375}, {"e", 1.5}, {"fresh", 0}});
    const Trends trends = trendsOf(earlier, now);
    EXPECT_EQ(trendLines(trends, now),
              (Lines{"1 new failure: a (roughness max 0.5 -> 2, 4 more metrics)",
                     "1 mended: b (roughness max 2 -> 0.5, 4 more metrics)",
                     "2 moved: d (roughness max 0.25 -> 0.375, 4 more metrics), e (roughness max 2 -> 1.5, 4 "
                     "more metrics)",
                     "1 new: fresh", "1 gone: old"}));
    const auto moved = [](double from, double to) {
        std::string all;
        const auto then = statsUpTo(from).byName(), here = statsUpTo(to).byName();
        for (std::size_t i = 0; i < then.size(); ++i)
            all += fmt::format(R"({}{{"channel":"roughness","figure":"{}","from":{},"to":{},"noise":0.0}})",
                               i == 0 ? "" : ",", then.at(i).first, nlohmann::json(then.at(i).second).dump(),
                               nlohmann::json(here.at(i).second).dump());
        return all;
    };
    EXPECT_EQ(
        jsonOf(trends, now).dump(),
        fmt::format(R"({{"report":"{}","device":null,"comparisons":[)"
                    R"({{"comparison":0,"scene":"a","kind":"new failure","moved":[{}]}},)"
                    R"({{"comparison":1,"scene":"b","kind":"mended","moved":[{}]}},)"
                    R"({{"comparison":3,"scene":"d","kind":"moved","moved":[{}]}},)"
                    R"({{"comparison":4,"scene":"e","kind":"moved","moved":[{}]}},)"
                    R"({{"comparison":5,"scene":"fresh","kind":"new","moved":[]}}],"gone":["old"]}})",
                    testFolder().string(), moved(0.5, 2), moved(2, 0.5), moved(0.25, 0.375), moved(2, 1.5)));
    EXPECT_EQ(nameOf(trends.comparisons[2].kind), "same");
    EXPECT_TRUE(trends.comparisons[2].moved.empty());
}

TEST(Trends, WithoutChangesThatIsSaid) {
    const Report same = scored({{"a", 0.5}, {"b", 2}});
    EXPECT_EQ(linesOf(same, same), Lines{"nothing has changed"});
    for (const ReportDevice& other :
         {ReportDevice{"another", "1.0", "cpu"}, ReportDevice{"a CPU", "2.0", "cpu"}}) {
        Report earlier = same;
        earlier.device = other;
        EXPECT_EQ(linesOf(earlier, same),
                  Lines{fmt::format(
                      "the earlier report is from another device ({}, {}): numbers may differ by rounding",
                      other.name, other.driver)});
        EXPECT_EQ(jsonOf(trendsOf(earlier, same), same)["device"], other.name + ", " + other.driver);
    }
}

// The noise of both paths now, plus twice the larger noise of then.
TEST(Trends, ChangesWithinTheNoiseAreNone) {
    Report earlier = scored({{"a", 0.5}, {"b", 0.5}});
    earlier.frames[0].noise[Channel::roughness] = {1, 0.125};
    earlier.frames[1].noise[Channel::roughness] = {1, 0.0625};
    earlier.frames[0].noise[Channel::metallic] = {1, 8};
    const auto now = [&](double max_a, double max_b) {
        Report report = scored({{"a", 0.5}, {"b", 0.5}});
        report.frames[0].noise[Channel::roughness] = {1, 0.03125};
        report.frames[1].noise[Channel::roughness] = {1, 0.0625};
        report.comparisons[0].channels[0].stats.max = max_a;
        report.comparisons[1].channels[0].stats.max = max_b;
        return report;
    };
    constexpr double all = 2 * 0.125 + 0.03125 + 0.0625;
    EXPECT_EQ(linesOf(earlier, now(0.5 + all, 0.5)), Lines{"nothing has changed"});
    EXPECT_EQ(linesOf(earlier, now(0.5 - all, 0.5)), Lines{"nothing has changed"});
    EXPECT_EQ(linesOf(earlier, now(0.5 + all + 0x1p-20, 0.5)),
              Lines{"1 moved: a (roughness max 0.5 -> 0.844)"});
    EXPECT_EQ(linesOf(earlier, now(0.5 - all - 0x1p-20, 0.5)),
              Lines{"1 moved: a (roughness max 0.5 -> 0.156)"});
    EXPECT_EQ(linesOf(earlier, now(0.5, 0.5 + 0x1p-20)), Lines{"1 moved: b (roughness max 0.5 -> 0.5)"})
        << "a's noise is not b's";
    const Report moved = now(0.5 + all + 0x1p-20, 0.5);
    EXPECT_EQ(jsonOf(trendsOf(earlier, moved), moved)["comparisons"][0]["moved"][0]["noise"], all);
}

TEST(Trends, InfinityIsAValueLikeOthers) {
    for (const auto& [then, now, line] : {std::tuple{endlessError, 1.5, "roughness max inf -> 1.5"},
                                          {1.5, endlessError, "roughness max 1.5 -> inf"}}) {
        const Report report = scored({{"a", now}});
        const Trends trends = trendsOf(scored({{"a", then}}), report);
        EXPECT_EQ(movedText(trends.comparisons[0].moved.at(0)), line);
        const auto json = jsonOf(trends, report)["comparisons"][0]["moved"][0];
        EXPECT_EQ(json["from"].is_null(), then == endlessError);
        EXPECT_EQ(json["to"].is_null(), now == endlessError);
    }
    const Report both = scored({{"a", endlessError}});
    EXPECT_EQ(linesOf(both, both), Lines{"nothing has changed"});
}

TEST(Trends, ChannelsComparedOnBothOccasionsAreEvaluated) {
    for (const Verdict verdict : {Verdict::pass, Verdict::fail, Verdict::forward_only, Verdict::deferred_only,
                                  Verdict::informative}) {
        Report earlier = scored({{"a", 0.5}}), now = scored({{"a", 0.75}});
        now.comparisons[0].failures = earlier.comparisons[0].failures = {"fails on both occasions"};
        earlier.comparisons[0].channels[0].verdict = verdict;
        const bool judged = verdict == Verdict::pass || verdict == Verdict::fail;
        EXPECT_EQ(trendsOf(earlier, now).comparisons[0].moved.size(), judged ? 5u : 0u) << nameOf(verdict);
        earlier.comparisons[0].channels[0].mode = &debugMode(Channel::metallic);
        EXPECT_TRUE(trendsOf(earlier, now).comparisons[0].moved.empty()) << "another channel";
    }
}

// Comparisons are told apart by scene, pair, camera, and their order.
TEST(Trends, AComparisonIsFoundAgain) {
    EXPECT_EQ(linesOf(scored({{"a", 0.5}, {"a", 2}}), scored({{"a", 0.5}, {"a", 0.5}})),
              Lines{"1 mended: a (roughness max 2 -> 0.5, 4 more metrics)"});
    EXPECT_EQ(linesOf(scored({{"a", 0.5}, {"a", 2}}), scored({{"a", 0.5}})), Lines{"1 gone: a"});
    EXPECT_EQ(linesOf(scored({{"a", 0.5}}), scored({{"a", 0.5}, {"a", 2}})), Lines{"1 new: a"});
    EXPECT_EQ(linesOf(scored({{"a", 0.5, "door"}, {"a", 0.5, "roof"}}), scored({{"a", 0.5, "top"}})),
              (Lines{"1 new: a", "1 gone: a"}))
        << "a scene is gone once";
    EXPECT_EQ(linesOf(scored({{"a", 0.5}}), scored({{"a", 0.5, "door"}, {"a", 0.5, "roof"}})),
              (Lines{"2 new: a, door, a, roof", "1 gone: a"}));
    for (const std::size_t frame : {0, 1}) {
        Report now = scored({{"a", 0.5}});
        now.frames[frame].name = "reference";
        EXPECT_EQ(linesOf(scored({{"a", 0.5}}), now), (Lines{"1 new: a", "1 gone: a"}));
    }
}

TEST(Trends, EightPlacesAreNamed) {
    std::vector<Scored> all;
    for (const char* scene : {"a", "b", "c", "d", "e", "f", "g", "h"}) all.push_back({scene, 0.5});
    EXPECT_EQ(linesOf(scored(all), scored({})), Lines{"8 gone: a, b, c, d, e, f, g, h"});
    EXPECT_EQ(linesOf(scored({}), scored(all)), Lines{"8 new: a, b, c, d, e, f, g, h"});
    all.push_back({"i", 0.5});
    EXPECT_EQ(linesOf(scored(all), scored({})), Lines{"9 gone: a, b, c, d, e, f, g, h and 1 more"});
    EXPECT_EQ(linesOf(scored({}), scored(all)), Lines{"9 new: a, b, c, d, e, f, g, h and 1 more"});
}

TEST(Trends, OtherFilesAreNamed) {
    const fs::path here = folder();
    const std::string file = (here / "other.json").string();
    const auto fault = [&] { return faultOf([&] { trendsSince(file, {}, {}); }); };
    EXPECT_TRUE(fault().starts_with("--since " + file + ": ")) << fault();
    for (const char* other : {R"({"software": "other", "comparisons": []})", R"({"software": "diptych"})",
                              R"({"comparisons": []})", "[]"}) {
        std::ofstream(file) << other;
        EXPECT_EQ(fault(),
                  "--since " + file + ": is not a report of compare; give its folder or report.json");
    }
    std::ofstream(file) << R"({"software": "diptych", "comparisons": [], "frames": []})";
    EXPECT_EQ(fault(), "--since " + file + ": has no \"device\"");
    std::ofstream(file) << reportJson(scored({}), nullptr);
    EXPECT_EQ(fault(), "") << "the file instead of its folder";
}

}  // namespace
}  // namespace diptych
