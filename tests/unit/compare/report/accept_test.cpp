// SPDX-License-Identifier: MIT
// Rules that accept what a report found: whose, how much, why; and what no rule can accept.
#include "compare/report/accept.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// Scene "a" against the reference and path against path, and scene "b". Roughness and metallic fail.
constexpr const char* acceptable = R"({"software": "diptych", "comparisons": [
    {"scene": "a", "baseline": "reference", "test": "deferred", "failures": [], "channels": [
        {"name": "roughness", "verdict": "fail", "max": 0.25}, {"name": "lit", "verdict": "pass", "max": 9}]},
    {"scene": "a", "baseline": "deferred", "test": "forward_plus", "failures": [], "channels": [
        {"name": "roughness", "verdict": "fail", "max": 0.125},
        {"name": "metallic", "verdict": "fail", "max": 0.5}]},
    {"scene": "b", "baseline": "deferred", "test": "forward_plus", "channels": [
        {"name": "roughness", "verdict": "fail", "max": 0.75}, {"name": "only", "verdict": "forward-only"}]}]})";

struct Accepting {
    fs::path here = folder(), out = here / "rules.json";
    explicit Accepting(const std::string& report = acceptable) {
        std::ofstream(here / "report.json") << report;
    }
    std::string fault(const std::string& scene = "", const std::string& channel = "") const {
        return faultOf([&] { acceptDifferences({here, scene, channel, ""}, out); });
    }
};

TEST(Accept, EachFailingChannelHasARuleOfItsLargestDifference) {
    const Accepting all;
    EXPECT_EQ(acceptDifferences({all.here, "", "", ""}, all.out), 3u);
    const std::string in = " as in " + all.here.string();
    const nlohmann::ordered_json expected{{"rules",
                                           {{{"scene", "a"},
                                             {"channel", "metallic"},
                                             {"max", 0.5},
                                             {"because", "accepted: forward_plus against deferred" + in}},
                                            {{"scene", "a"},
                                             {"channel", "roughness"},
                                             {"max", 0.25},
                                             {"because", "accepted: deferred against reference" + in}},
                                            {{"scene", "b"},
                                             {"channel", "roughness"},
                                             {"max", 0.75},
                                             {"because", "accepted: forward_plus against deferred" + in}}}}};
    EXPECT_EQ(contentsOf(all.out), expected.dump(2) + "\n");
}

TEST(Accept, ASceneOrAChannelIsChosen) {
    const Accepting some;
    const auto accepted = [&](const std::string& scene, const std::string& channel) {
        fs::remove(some.out);
        const std::size_t count =
            acceptDifferences({some.here / "report.json", scene, channel, "why"}, some.out);
        std::string names;
        const auto rules = nlohmann::json::parse(contentsOf(some.out))["rules"];
        EXPECT_EQ(rules.size(), count);
        for (const auto& rule : rules) {
            EXPECT_EQ(rule["because"], "why");
            names += rule["scene"].get<std::string>() + "/" + rule["channel"].get<std::string>() + " ";
        }
        return names;
    };
    EXPECT_EQ(accepted("a", ""), "a/metallic a/roughness ");
    EXPECT_EQ(accepted("b", ""), "b/roughness ");
    EXPECT_EQ(accepted("", "roughness"), "a/roughness b/roughness ");
    EXPECT_EQ(accepted("a", "metallic"), "a/metallic ");
}

TEST(Accept, RulesOfOthersStay) {
    const Accepting again;
    const std::string others = R"({"scene": "a", "channel": "lit", "max": 1, "because": "mine"},)"
                               R"({"scene": "c", "channel": "roughness", "max": 2, "because": "mine"},)"
                               R"({"channel": "roughness", "max": 3, "because": "of all scenes"})";
    std::ofstream(again.out)
        << R"({"rules": [{"scene": "a", "channel": "roughness", "max": 4, "because": "old"},)" << others
        << "]}";
    EXPECT_EQ(acceptDifferences({again.here, "a", "roughness", "new"}, again.out), 1u);
    EXPECT_EQ(nlohmann::json::parse(contentsOf(again.out)),
              nlohmann::json::parse(
                  R"({"rules": [)" + others +
                  R"(, {"scene": "a", "channel": "roughness", "max": 0.25, "because": "new"}]})"));
    std::ofstream(again.out) << R"({"rules": [{"channel": "roughness", "max": 1}]})";
    EXPECT_NE(again.fault().find("because"), std::string::npos) << "the file is no rules file";
}

TEST(Accept, WhatCannotBeAcceptedIsSaid) {
    const Accepting whole;
    EXPECT_EQ(whole.fault("c"), "accept c: the report has no such scene");
    EXPECT_EQ(whole.fault("b", "metallic"),
              "accept b --channel metallic: nothing fails, so there is nothing to accept");
    EXPECT_EQ(whole.fault("", "lit"), "accept --channel lit: nothing fails, so there is nothing to accept");
    EXPECT_EQ(whole.fault("b", "only"),
              "accept b --channel only: nothing fails, so there is nothing to accept");
    EXPECT_FALSE(fs::exists(whole.out)) << "nothing is written";

    const Accepting passing(R"({"software": "diptych", "comparisons": [{"scene": "a", "channels": []}]})");
    EXPECT_EQ(passing.fault(), "accept: nothing fails, so there is nothing to accept");
    EXPECT_EQ(passing.fault("a"), "accept a: nothing fails, so there is nothing to accept");

    for (const char* max : {R"(, "max": null)", ""}) {
        const Accepting nan(R"({"software": "diptych", "comparisons": [{"scene": "a", "channels": [
            {"name": "lit", "verdict": "fail")" +
                            std::string(max) + "}]}]}");
        EXPECT_EQ(nan.fault(), "a, lit: differs by NaN or infinity; no rule can accept that");
    }
    const Accepting frames(
        R"({"software": "diptych", "comparisons": [{"scene": "a", "failures": ["one", "two"],
        "channels": [{"name": "lit", "verdict": "fail", "max": 1}]}]})");
    EXPECT_EQ(frames.fault(), "a: fails as a whole, not in one channel; no rule can accept that: one");
    EXPECT_EQ(frames.fault("", "lit"), "") << "but its channel can be";
}

TEST(Accept, OtherFilesAreNoReports) {
    for (const char* other : {R"({"software": "other", "comparisons": []})", R"({"software": "diptych"})"}) {
        const Accepting from(other);
        EXPECT_EQ(from.fault(),
                  "accept " + from.here.string() +
                      ": is not a report written by compare; give its folder or its report.json");
    }
}

}  // namespace
}  // namespace diptych
