// SPDX-License-Identifier: MIT
#include "compare/verdict/rules.h"

#include "shared/image/file_bytes.h"
#include "shared/text/did_you_mean.h"
#include "shared/text/digits.h"
#include "shared/text/fail.h"
#include "shared/text/json.h"
#include "shared/text/named.h"
#include "shared/text/wildcard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <ranges>
#include <set>
#include <utility>

namespace diptych {
namespace {

using Json = nlohmann::json;

using Presets = std::map<std::string, Json>;

std::string metricNames() {
    return fmt::format("{}, {}", fmt::join(allMetrics() | std::views::transform(&Metric::name), ", "),
                       FAILING);
}

double numberOf(const Json& value, const std::string& what) {
    if (!value.is_number()) fail(fmt::format("{} is {}, not a number", what, oneLine(value.dump(), 60)));
    return value.get<double>();
}

Condition bound(const std::string& metric, const Json& value) {
    const double limit = numberOf(value, metric);
    if (!(limit >= 0)) fail(fmt::format("{} {} is negative; give 0 or more", metric, limit));
    return {Condition::Kind::bound, {metric, 0}, limit, {}};
}

// { "above": error, "share": fraction of the pixels }
Condition fraction(const Json& value) {
    if (!value.is_object() || value.size() != 2 || !value.contains("above") || !value.contains("share"))
        fail("failing must be { \"above\": ERROR, \"share\": 0 to 1 }");
    const double above = numberOf(value["above"], "above"), max = numberOf(value["share"], "share");
    if (!(above >= 0)) fail(fmt::format("failing: above {} is negative; give 0 or more", above));
    if (!(max >= 0 && max <= 1)) fail(fmt::format("failing: share {} is not between 0 and 1", max));
    return {Condition::Kind::bound, {FAILING, above}, max, {}};
}

class ConditionReader {
public:
    explicit ConditionReader(const Presets& presets) : presets_(presets) {}

    // A condition from all members of the object except `others`; all must pass.
    Condition read(const Json& object, const std::set<std::string>& others = {}) {
        if (!object.is_object())
            fail(fmt::format("{} is not an object of limits", oneLine(object.dump(), 60)));
        Condition all{Condition::Kind::all, {}, 0, {}};
        for (const auto& [key, value] : object.items())
            if (!others.contains(key)) all.parts.push_back(member(key, value));
        return all.parts.size() == 1 ? std::move(all.parts.front()) : all;
    }

private:
    const Presets& presets_;
    std::vector<std::string> open_;  // presets being read

    Condition member(const std::string& key, const Json& value) {
        if (key == "all" || key == "any") return group(key, value);
        if (key == "preset") return preset(value);
        if (key == FAILING) return fraction(value);
        if (findMetric(key)) return bound(key, value);
        fail(fmt::format("unknown metric {}; use one of {}, all, any, preset", oneLine(key), metricNames()));
    }

    Condition group(const std::string& key, const Json& value) {
        if (!value.is_array() || value.empty()) fail(key + " is not a non-empty array of limits");
        Condition group{key == "all" ? Condition::Kind::all : Condition::Kind::any, {}, 0, {}};
        for (const Json& part : value) group.parts.push_back(read(part));
        return group;
    }

    Condition preset(const Json& value) {
        if (!value.is_string()) fail("preset is not a string");
        const std::string name = value.get<std::string>();
        const auto found = presets_.find(name);
        if (found == presets_.end()) fail(fmt::format("unknown preset {}", oneLine(name)));
        if (std::ranges::count(open_, name)) fail(fmt::format("preset {} refers to itself", oneLine(name)));
        open_.push_back(name);
        Condition condition = read(found->second, {"because"});
        open_.pop_back();
        return condition;
    }
};

std::string textOf(const Json& object, const char* key, const char* what) {
    const auto at = object.find(key);
    if (at == object.end() || !at->is_string() || at->get_ref<const std::string&>().empty())
        fail(fmt::format("has no valid {}: {}", key, what));
    return oneLine(at->get<std::string>(), 400);
}

Rule readRule(const Json& json, const Presets& presets) {
    if (!json.is_object()) fail("is not an object");
    Rule rule;
    rule.channel = textOf(json, "channel", "give the name or pattern of channels");
    if (json.contains("scene")) rule.scene = textOf(json, "scene", "give the name or pattern of scenes");
    rule.because = textOf(json, "because", "give the reason for the limit");
    rule.fail = ConditionReader(presets).read(json, {"channel", "scene", "because", "warn"});
    if (json.contains("warn")) rule.warn = ConditionReader(presets).read(json["warn"]);
    if (rule.fail.kind == Condition::Kind::all && rule.fail.parts.empty() && !rule.warn)
        fail(fmt::format("sets no limit; use one of {}", metricNames()));
    return rule;
}

std::vector<Rule> readDocument(const Json& document, const std::string& name) {
    if (!document.is_object()) fail("is not an object with rules");
    for (const auto& [key, value] : document.items())
        if (key != "$schema" && key != "presets" && key != "rules")
            fail(fmt::format("unknown member {}; use presets and rules", oneLine(key)));
    Presets presets;
    if (document.contains("presets")) {
        if (!document["presets"].is_object()) fail("presets: is not an object");
        presets = document["presets"].get<Presets>();
    }
    for (const auto& [key, value] : presets)  // also unused ones
        named("preset " + oneLine(key), [&] { return ConditionReader(presets).read(Json{{"preset", key}}); });
    const auto list = document.find("rules");
    if (list == document.end() || !list->is_array()) fail("has no array \"rules\"");
    std::vector<Rule> rules;
    for (std::size_t i = 0; i < list->size(); ++i) {
        rules.push_back(named(fmt::format("rule {}", i + 1), [&] { return readRule((*list)[i], presets); }));
        rules.back().origin = fmt::format("{}, rule {}", name, i + 1);
    }
    return rules;
}

std::string quantityText(const Quantity& quantity) {
    return quantity.metric == FAILING ? fmt::format("share of pixels above {:g}", quantity.above)
                                      : quantity.metric;
}

std::optional<std::string> boundViolation(const Condition& c, const Measured& measured) {
    const std::optional<double> value = measured(c.quantity);
    const std::string what = quantityText(c.quantity);
    if (!value) return fmt::format("{} is not defined for this channel", what);
    const bool min = isBetterIfMore(c.quantity.metric);
    if (min ? *value >= c.limit : *value <= c.limit) return {};
    return fmt::format("{} {} {} {}", what, distinguishingDigits(*value, c.limit, 4),
                       min ? "is below" : "exceeds", distinguishingDigits(c.limit, *value, 4));
}

std::string joined(const Condition& condition, const char* word) {
    std::vector<std::string> parts;
    for (const Condition& part : condition.parts) {
        const std::string text = conditionText(part);
        parts.push_back(part.kind == Condition::Kind::bound ? text : "(" + text + ")");
    }
    return fmt::format("{}", fmt::join(parts, word));
}

}  // namespace

double usedOf(const Criterion& criterion) {
    const auto [over, under] = criterion.min ? std::pair{criterion.limit, criterion.measured}
                                             : std::pair{criterion.measured, criterion.limit};
    if (over == 0 || over == under) return over == 0 ? 0 : 1;
    return under > 0 ? over / under : std::numeric_limits<double>::infinity();
}

std::string fractionText(const Criterion& criterion) {
    return fmt::format(
        fmt::runtime(criterion.differing ? "; {} of the pixels differ" : ", at {} of the pixels"),
        percentText(criterion.fraction));
}

std::string percentText(double fraction) {
    if (fraction > 0 && fraction < 1e-4) return "under 0.01 %";
    if (fraction < 1 && fraction > 0.9999) return "over 99.99 %";
    return fmt::format("{:.{}g} %", 100 * fraction, fraction > 0.999 && fraction < 1 ? 4 : 3);
}

std::optional<std::string> violation(const Condition& condition, const Measured& measured) {
    if (condition.kind == Condition::Kind::bound) return boundViolation(condition, measured);
    const bool any = condition.kind == Condition::Kind::any;
    std::vector<std::string> reasons;
    for (const Condition& part : condition.parts) {
        std::optional<std::string> why = violation(part, measured);
        if (any && !why) return {};
        if (why) reasons.push_back(std::move(*why));
    }
    if (reasons.empty()) return {};
    return fmt::format("{}", fmt::join(reasons, any ? ", and " : ", "));
}

std::optional<Criterion> decidingBound(const Condition& condition, const Measured& measured) {
    if (condition.kind == Condition::Kind::bound) {
        const std::optional<double> value = measured(condition.quantity);
        if (!value) return {};
        const bool fraction = condition.quantity.metric == FAILING;
        return Criterion{.metric = quantityText(condition.quantity),
                         .measured = *value,
                         .limit = condition.limit,
                         .min = isBetterIfMore(condition.quantity.metric),
                         .above = fraction ? std::optional(condition.quantity.above) : std::nullopt};
    }
    std::optional<Criterion> deciding;
    for (const Condition& part : condition.parts)
        if (const auto bound = decidingBound(part, measured))
            if (!deciding || (condition.kind == Condition::Kind::any ? usedOf(*bound) < usedOf(*deciding)
                                                                     : usedOf(*bound) > usedOf(*deciding)))
                deciding = bound;
    return deciding;
}

bool boundsMetric(const Condition& condition, std::string_view metric) {
    return condition.kind == Condition::Kind::bound
               ? condition.quantity.metric == metric
               : std::ranges::any_of(condition.parts,
                                     [&](const auto& part) { return boundsMetric(part, metric); });
}

bool boundsOnly(const Condition& condition, std::string_view metric) {
    return condition.kind == Condition::Kind::bound
               ? condition.quantity.metric == metric
               : !condition.parts.empty() && std::ranges::all_of(condition.parts, [&](const auto& part) {
                     return boundsOnly(part, metric);
                 });
}

std::optional<double> boundOn(const Condition& condition, std::string_view metric) {
    if (condition.kind == Condition::Kind::bound)
        return condition.quantity.metric == metric ? std::optional(condition.limit) : std::nullopt;
    if (condition.kind == Condition::Kind::any) return {};
    std::optional<double> min;
    for (const Condition& part : condition.parts)
        if (const auto bound = boundOn(part, metric)) min = std::min(*bound, min.value_or(*bound));
    return min;
}

std::string conditionText(const Condition& condition) {
    if (condition.kind == Condition::Kind::all) return joined(condition, " and ");
    if (condition.kind == Condition::Kind::any) return joined(condition, " or ");
    return fmt::format("{} {} {:g}", quantityText(condition.quantity),
                       isBetterIfMore(condition.quantity.metric) ? ">=" : "<=", condition.limit);
}

std::string_view nameOf(Level level) {
    return level == Level::pass ? "pass" : level == Level::warn ? "warn" : "fail";
}

Decision decide(const Rule& rule, const Measured& measured) {
    const std::optional<Criterion> criterion = decidingBound(rule.fail, measured);
    if (auto why = violation(rule.fail, measured)) return {Level::fail, &rule, *why, criterion};
    if (rule.warn)
        if (auto why = violation(*rule.warn, measured)) return {Level::warn, &rule, *why, criterion};
    return {Level::pass, &rule, {}, criterion};
}

const Rule* ruleFor(std::span<const Rule> rules, std::string_view channel) {
    for (std::size_t i = rules.size(); i-- > 0;)
        if (matches(rules[i].channel, channel)) return &rules[i];
    return nullptr;
}

std::vector<Rule> rulesOfScene(std::span<const Rule> rules, std::string_view scene) {
    std::vector<Rule> of;
    std::ranges::copy_if(rules, std::back_inserter(of),
                         [&](const Rule& rule) { return matches(rule.scene, scene); });
    return of;
}

bool namesChannels(const Rule& rule) {
    return rule.channel.find_first_not_of('*') != std::string::npos;
}

bool isPattern(const Rule& rule) {
    return rule.channel.find_first_of("*?") != std::string::npos;
}

std::vector<const Rule*> idleRules(std::span<const Rule> rules, const std::vector<std::string>& channels) {
    std::vector<const Rule*> idle;
    for (const Rule& rule : rules)
        if (std::ranges::none_of(channels, [&](const auto& name) { return matches(rule.channel, name); }))
            idle.push_back(&rule);
    return idle;
}

std::string idleText(const Rule& rule, const std::vector<std::string>& channels) {
    return fmt::format("{}: no channel here is called {}{}", rule.origin, rule.channel,
                       isPattern(rule) ? "" : didYouMean(rule.channel, channels));
}

void evaluateOneSided(const std::string& channel, const std::string& owner, const ChannelDemands& demands,
                      std::vector<std::string>& failures, std::vector<std::string>& notes) {
    const std::string alone = fmt::format("{} is in {} only", channel, owner);
    const Rule* rule = ruleFor(demands.rules, channel);
    if (rule && namesChannels(*rule))
        failures.push_back(fmt::format("{}, but {} needs both sides", alone, rule->origin));
    else if (std::ranges::count(demands.names, channel) > 0)
        failures.push_back(fmt::format("{}, but --channels requests it", alone));
    else if (demands.all)
        failures.push_back(alone + ", but --strict requires the same channels on both sides");
    else
        notes.push_back(alone + ": not compared");
}

void checkChannels(std::span<const Rule> rules, const std::vector<std::string>& known) {
    for (const Rule* rule : idleRules(rules, known))
        if (!isPattern(*rule))
            throw std::runtime_error(fmt::format("{}: no channel is called {}{}", rule->origin, rule->channel,
                                                 didYouMean(rule->channel, known)));
}

std::vector<Rule> rulesFromJson(std::string_view text, const std::string& name) {
    return named(
        name, [&] { return readDocument(parseJson(text), std::filesystem::path(name).filename().string()); });
}

std::vector<Rule> readRules(const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = bytesOf(file);
    return rulesFromJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace diptych
