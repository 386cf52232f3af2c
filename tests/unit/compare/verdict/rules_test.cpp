// SPDX-License-Identifier: MIT
// Tolerance files: syntax, verdicts, and the line named in errors.
#include "compare/verdict/rules.h"
#include "shared/text/wildcard.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace diptych {
namespace {

using Json = nlohmann::json;

Measured of(std::map<std::string, double> values) {
    return [values](const Quantity& q) -> std::optional<double> {
        const auto found = values.find(q.metric);
        return found == values.end() ? std::nullopt : std::optional(found->second);
    };
}

Rule onlyRule(const Json& rule, const Json& presets = Json::object()) {
    return rulesFromJson(Json{{"presets", presets}, {"rules", {rule}}}.dump(), "t.json").at(0);
}

std::string fault(const Json& document) {
    return faultOf([&] {
        rulesFromJson(document.is_string() ? document.get<std::string>() : document.dump(), "dir/t.json");
    });
}

std::string faultOfRule(const Json& rule) {
    return fault({{"rules", {rule}}});
}

TEST(Rules, TheLastThatNamesAChannelDecides) {
    const auto rules = rulesFromJson(R"({"rules": [
        {"channel": "*", "max": 0, "because": "equal"},
        {"channel": "lit*", "max": 0.5, "because": "half"},
        {"channel": "lit_diffuse", "mean": 0.1, "because": "tenth"}]})",
                                     "some/t.json");
    EXPECT_EQ(ruleFor(rules, "albedo")->because, "equal");
    EXPECT_EQ(ruleFor(rules, "lit")->because, "half");
    EXPECT_EQ(ruleFor(rules, "lit_diffuse")->because, "tenth");
    EXPECT_EQ(ruleFor(rules, "lit")->origin, "t.json, rule 2");
    EXPECT_EQ(ruleFor({}, "lit"), nullptr);
}

TEST(Rules, PatternsAreOfTheWholeName) {
    EXPECT_TRUE(matches("lit", "lit"));
    EXPECT_FALSE(matches("lit", "lit_diffuse"));
    EXPECT_TRUE(matches("*", ""));
    EXPECT_TRUE(matches("l*t*e", "lit_diffuse"));
    EXPECT_FALSE(matches("l*t*d", "lit_diffuse"));
    EXPECT_TRUE(matches("?it", "lit"));
    EXPECT_FALSE(matches("?", ""));
    EXPECT_TRUE(matches("a*b*c", "aXbXbc"));
}

TEST(Rules, EveryMemberMustHold) {
    const Rule rule = onlyRule({{"channel", "normals"}, {"max", 0.5}, {"mean", 0.1}, {"because", "x"}});
    EXPECT_EQ(decide(rule, of({{"max", 0.5}, {"mean", 0.1}})).level, Level::pass) << "a bound itself passes";
    const Decision one = decide(rule, of({{"max", 0.6}, {"mean", 0.1}}));
    EXPECT_EQ(one.level, Level::fail);
    EXPECT_EQ(one.reason, "max 0.6 exceeds 0.5");
    EXPECT_EQ(decide(rule, of({{"max", 0.6}, {"mean", 0.2}})).reason,
              "max 0.6 exceeds 0.5, mean 0.2 exceeds 0.1");
}

TEST(Rules, OneOfAnySuffices) {
    const Rule rule = onlyRule({{"channel", "lit"},
                                {"any", {{{"flip", 0.01}}, {{"all", {{{"flip", 0.05}}, {{"psnr", 40}}}}}}},
                                {"because", "x"}});
    EXPECT_EQ(decide(rule, of({{"flip", 0.01}, {"psnr", 10}})).level, Level::pass);
    EXPECT_EQ(decide(rule, of({{"flip", 0.05}, {"psnr", 40}})).level, Level::pass);
    const Decision d = decide(rule, of({{"flip", 0.05}, {"psnr", 39}}));
    EXPECT_EQ(d.reason, "flip 0.05 exceeds 0.01, and psnr 39 is below 40") << "more decibels are better";
    EXPECT_EQ(conditionText(rule.fail), "flip <= 0.01 or (flip <= 0.05 and psnr >= 40)");
}

TEST(Rules, AWarningIsNoFailure) {
    const Rule rule = onlyRule({{"channel", "lit"}, {"max", 1}, {"warn", {{"max", 0.5}}}, {"because", "x"}});
    EXPECT_EQ(decide(rule, of({{"max", 0.5}})).level, Level::pass);
    EXPECT_EQ(decide(rule, of({{"max", 0.7}})).level, Level::warn);
    EXPECT_EQ(decide(rule, of({{"max", 0.7}})).reason, "max 0.7 exceeds 0.5");
    EXPECT_EQ(decide(rule, of({{"max", 1.5}})).level, Level::fail);
}

TEST(Rules, WhatIsNanOrNotDefinedNeverHolds) {
    const Rule rule = onlyRule({{"channel", "lit"}, {"flip", 1}, {"because", "x"}});
    EXPECT_EQ(decide(rule, of({{"flip", std::nan("")}})).level, Level::fail);
    EXPECT_EQ(decide(rule, of({})).reason, "flip is not defined for this channel");
}

TEST(Rules, AFractionOfPixelsMayFail) {
    const Rule rule = onlyRule(
        {{"channel", "lit"}, {"failing", {{"above", 0.02}, {"share", 0.001}}}, {"because", "5 of 255"}});
    EXPECT_EQ(rule.fail.quantity.metric, "failing");
    EXPECT_EQ(rule.fail.quantity.above, 0.02);
    EXPECT_EQ(decide(rule, of({{"failing", 0.001}})).level, Level::pass);
    EXPECT_EQ(decide(rule, of({{"failing", 0.002}})).reason,
              "share of pixels above 0.02 0.002 exceeds 0.001");
}

TEST(Rules, PresetsLeadToPresets) {
    const Json presets{{"close", {{"max", 0.1}, {"because", "8 bits"}}},
                       {"closer", {{"all", {{{"preset", "close"}}, {{"mean", 0.01}}}}}}};
    const Rule rule = onlyRule({{"channel", "lit"}, {"preset", "closer"}, {"because", "x"}}, presets);
    EXPECT_EQ(decide(rule, of({{"max", 0.1}, {"mean", 0.01}})).level, Level::pass);
    EXPECT_EQ(decide(rule, of({{"max", 0.2}, {"mean", 0.01}})).level, Level::fail);
    EXPECT_EQ(boundOn(rule.fail, "max"), 0.1);
    EXPECT_EQ(boundOn(rule.fail, "flip"), std::nullopt);
}

TEST(Rules, NumbersThatRoundAlikeAreToldApart) {
    const Rule rule = onlyRule({{"channel", "lit"}, {"max", 0.1}, {"because", "x"}});
    EXPECT_EQ(decide(rule, of({{"max", 0.1000004}})).reason, "max 0.1000004 exceeds 0.1");
}

TEST(Rules, FaultsWordByWord) {
    EXPECT_EQ(fault("nonsense"),
              "dir/t.json: is not JSON: parse error at line 1, column 2: syntax error while "
              "parsing value - invalid literal; last read: 'no'");
    EXPECT_EQ(fault(Json::array()), "dir/t.json: is not an object with rules");
    EXPECT_EQ(fault({{"rule", 1}}), "dir/t.json: unknown member rule; use presets and rules");
    EXPECT_EQ(fault(Json::object()), "dir/t.json: has no array \"rules\"");
    EXPECT_EQ(faultOfRule(7), "dir/t.json: rule 1: is not an object");
    EXPECT_EQ(faultOfRule({{"max", 1}, {"because", "x"}}),
              "dir/t.json: rule 1: has no valid channel: give the name or pattern of channels");
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"max", 1}}),
              "dir/t.json: rule 1: has no valid because: give the reason for the limit");
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"max", "1"}, {"because", "x"}}),
              "dir/t.json: rule 1: max is \"1\", not a number");
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"max", -1}, {"because", "x"}}),
              "dir/t.json: rule 1: max -1 is negative; give 0 or more");
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"maxx", 1}, {"because", "x"}})
                  .find("dir/t.json: rule 1: unknown metric maxx; use one of max, mean, "),
              0u);
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"preset", "p"}, {"because", "x"}}),
              "dir/t.json: rule 1: unknown preset p");
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"any", Json::array()}, {"because", "x"}}),
              "dir/t.json: rule 1: any is not a non-empty array of limits");
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"failing", {{"above", 1}}}, {"because", "x"}}),
              "dir/t.json: rule 1: failing must be { \"above\": ERROR, \"share\": 0 to 1 }");
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"failing", {{"above", 1}, {"share", 2}}}, {"because", "x"}}),
              "dir/t.json: rule 1: failing: share 2 is not between 0 and 1");
    EXPECT_EQ(faultOfRule({{"channel", "lit"}, {"because", "x"}}).find("dir/t.json: rule 1: sets no limit"),
              0u);
    EXPECT_EQ(
        fault({{"presets", {{"a", {{"preset", "b"}}}, {"b", {{"preset", "a"}}}}}, {"rules", Json::array()}}),
        "dir/t.json: preset a: preset a refers to itself");
    EXPECT_EQ(fault(std::string(200, '[')), "dir/t.json: is nested deeper than 128 levels");
}

// What a condition bounds by all, or by any, of its parts.
TEST(Rules, ABoundOfPartsAppliesIfItAlwaysDoes) {
    const auto bound = [](const char* metric, double limit) {
        return Condition{Condition::Kind::bound, {metric, 0}, limit, {}};
    };
    const auto of = [](Condition::Kind kind, std::vector<Condition> parts) {
        return Condition{kind, {}, 0, std::move(parts)};
    };
    constexpr auto all = Condition::Kind::all, any = Condition::Kind::any;
    struct Row {
        Condition condition;
        bool bounds, only;
        std::optional<double> limit;
        const char* text;
    };
    const Condition one = bound("max", 1), two = bound("max", 2), mean = bound("mean", 3);
    const Row rows[] = {
        {one, true, true, 1, "max <= 1"},
        {mean, false, false, {}, "mean <= 3"},
        {of(all, {}), false, false, {}, ""},
        {of(all, {one, two}), true, true, 1, "max <= 1 and max <= 2"},
        {of(all, {two, one}), true, true, 1, "max <= 2 and max <= 1"},
        {of(all, {mean, two}), true, false, 2, "mean <= 3 and max <= 2"},
        {of(any, {one, two}), true, true, {}, "max <= 1 or max <= 2"},
        {of(any, {mean, mean}), false, false, {}, "mean <= 3 or mean <= 3"},
        {of(all, {of(any, {one, mean}), two}), true, false, 2, "(max <= 1 or mean <= 3) and max <= 2"}};
    for (const Row& row : rows) {
        EXPECT_EQ(conditionText(row.condition), row.text);
        EXPECT_EQ(boundsMetric(row.condition, "max"), row.bounds) << row.text;
        EXPECT_EQ(boundsOnly(row.condition, "max"), row.only) << row.text;
        EXPECT_EQ(boundOn(row.condition, "max"), row.limit) << row.text;
    }
    EXPECT_EQ(conditionText({Condition::Kind::bound, {"failing", 0.5}, 0.25, {}}),
              "share of pixels above 0.5 <= 0.25");
}

TEST(Rules, PatternsAreToldFromNames) {
    struct Row {
        const char* channel;
        bool names, pattern;
        const char* idle;
    };
    const std::vector<std::string> channels{"lit", "albedo"};
    for (const Row& row : {Row{"*", false, true, nullptr},
                           {"**", false, true, nullptr},
                           {"l?t", true, true, nullptr},
                           {"lit", true, false, nullptr},
                           {"x*", true, true, "t.json, rule 1: no channel here is called x*"},
                           {"?", true, true, "t.json, rule 1: no channel here is called ?"},
                           {"albeod", true, false,
                            "t.json, rule 1: no channel here is called albeod; did you mean albedo?"}}) {
        const Rule rule = onlyRule({{"channel", row.channel}, {"max", 1}, {"because", "x"}});
        EXPECT_EQ(namesChannels(rule), row.names) << row.channel;
        EXPECT_EQ(isPattern(rule), row.pattern) << row.channel;
        const auto idle = idleRules(std::span(&rule, 1), channels);
        ASSERT_EQ(idle.size(), row.idle ? 1u : 0u) << row.channel;
        if (row.idle) {
            EXPECT_EQ(idleText(*idle[0], channels), row.idle);
        }
    }
}

TEST(Rules, OfASceneAreThoseOfItsNameAndOfAll) {
    const auto rules = rulesFromJson(R"({"rules": [
        {"channel": "lit", "max": 1, "because": "all"},
        {"channel": "lit", "scene": "builtin:*", "max": 1, "because": "ours"},
        {"channel": "lit", "scene": "a.glb", "max": 1, "because": "one"}]})",
                                     "t.json");
    for (const auto& [scene, reasons] :
         {std::pair{"builtin:one", "all ours "}, {"a.glb", "all one "}, {"b.glb", "all "}}) {
        std::string found;
        for (const Rule& rule : rulesOfScene(rules, scene)) found += rule.because + " ";
        EXPECT_EQ(found, reasons);
    }
    EXPECT_EQ(nameOf(Level::pass), "pass");
    EXPECT_EQ(nameOf(Level::warn), "warn");
    EXPECT_EQ(nameOf(Level::fail), "fail");
}

// The JSON schema for editors has the same metrics.
TEST(Rules, TheSchemaNamesEveryMetric) {
    std::ifstream stream(DIPTYCH_SOURCE_DIR "/compare/verdict/tolerances.schema.json");
    const Json schema = Json::parse(stream);
    std::string names = "^(";
    for (const Metric& metric : allMetrics())
        names += std::string(names.size() > 2 ? "|" : "") + std::string(metric.name);
    const Json& patterns = schema["$defs"]["bounds"]["patternProperties"];
    EXPECT_TRUE(patterns.contains(names + ")$")) << names << ")$";
    for (const char* key : {"all", "any", "preset", "failing"})
        EXPECT_TRUE(schema["$defs"]["bounds"]["properties"].contains(key)) << key;
}

}  // namespace
}  // namespace diptych
