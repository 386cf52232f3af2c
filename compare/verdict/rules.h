// SPDX-License-Identifier: MIT
// Tolerances as data: the rules of a tolerance file and their decisions on metrics. Modelled on Filament's
// renderdiff presets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// A metric of two images of a channel, which a rule may bound.
struct Metric {
    std::string_view name;
    bool more_is_better;       // psnr, ssim: a bound is the smallest value that passes
    std::string_view meaning;  // formula, unit and source, one line
};
std::span<const Metric> allMetrics();
const Metric* findMetric(std::string_view name);  // nullptr if unknown
bool isBetterIfMore(std::string_view name);

inline constexpr const char* FAILING = "failing";

// A metric, or the fraction of pixels, 0 to 1, whose error in the channel's error kind exceeds `above`.
struct Quantity {
    std::string metric;  // FAILING for the fraction
    double above = 0;
};
// Returns the measured value of a quantity; empty if it is undefined for the channel (flip of an id).
using Measured = std::function<std::optional<double>(const Quantity&)>;

// The metric that decided a verdict, as measured, and its limit.
struct Criterion {
    // A metric of rules.h, "p99.9", "pixels unexplained", "times the bounds", "flip of detail", "pixels
    // NaN or infinite", "p99.9 of the excess" (certainErrors()).
    std::string metric;
    double measured = 0;
    double limit = 0;               // largest value that passes; with `min` the smallest
    bool min = false;               // for psnr and ssim
    std::optional<double> above{};  // if the metric is a fraction of pixels: their error threshold
    // Covered pixels out of tolerance; for a metric of the whole channel (a mean, FLIP), those that differ
    // at all.
    std::uint64_t pixels = 0;
    double fraction = 0;     // `pixels` as a fraction of all covered pixels, 0 to 1
    bool differing = false;  // `pixels` counts pixels that differ
};

// Fraction of the limit that is used: 1 just passes; infinite if the limit is 0 and the metric is not.
double usedOf(const Criterion& criterion);

// ", at 12.3 % of the pixels"; for a metric of the whole channel "; 12.3 % of the pixels differ".
std::string fractionText(const Criterion& criterion);

// "12.3 %"; never "0 %" for a non-zero fraction, nor "100 %" for less than all.
std::string percentText(double fraction);

// A bound on one quantity, or several conditions of which all or any must pass.
struct Condition {
    enum class Kind { bound, all, any };
    Kind kind = Kind::all;
    Quantity quantity;
    double limit = 0;  // upper limit; lower limit if more is better
    std::vector<Condition> parts;
};
// Why the condition fails, e.g. "max 0.005 exceeds 0.0037"; empty if it passes. A quantity that is NaN or
// undefined never passes.
std::optional<std::string> violation(const Condition& condition, const Measured& measured);

// The bound that decides whether the condition passes, without `Criterion::pixels`. Among bounds that must
// all pass, it is the one with the highest use (usedOf()); among alternatives, the one with the lowest. Empty
// if the condition bounds nothing, or a metric that is undefined for the channel.
std::optional<Criterion> decidingBound(const Condition& condition, const Measured& measured);

// Whether any part of the condition bounds the metric.
bool boundsMetric(const Condition& condition, std::string_view metric);
// Whether all parts of the condition do, and there is one.
bool boundsOnly(const Condition& condition, std::string_view metric);
// The smallest upper bound on the metric that always applies; empty if there is none.
std::optional<double> boundOn(const Condition& condition, std::string_view metric);

// "max <= 0.0037 and (flip <= 0.02 or psnr >= 40)"
std::string conditionText(const Condition& condition);

struct Rule {
    std::string channel = "*";      // a name, or a pattern with * and ?
    std::string scene = "*";        // the same for the scene's name on the command line; for compare
    Condition fail;                 // the channel fails unless this passes
    std::optional<Condition> warn;  // a warning unless this passes
    std::string because;
    std::string origin;  // "tolerances.json, rule 3"; printed with its decision
};

enum class Level { pass, warn, fail };
std::string_view nameOf(Level level);

struct Decision {
    Level level = Level::pass;
    const Rule* rule = nullptr;
    std::string reason;                    // of a warning or failure; else empty
    std::optional<Criterion> criterion{};  // the deciding bound, if the rule has one
};
Decision decide(const Rule& rule, const Measured& measured);

// The last rule whose pattern the channel matches, as in a list of exceptions; nullptr: none.
const Rule* ruleFor(std::span<const Rule> rules, std::string_view channel);

// Rules whose pattern matches the scene.
std::vector<Rule> rulesOfScene(std::span<const Rule> rules, std::string_view scene);

// Whether the rule names channels and does not apply to all ("*").
bool namesChannels(const Rule& rule);

// Whether the rule's channel is a pattern (* and ?) rather than one name.
bool isPattern(const Rule& rule);

// Rules that match none of the channels; and the message about one of them, which suggests a similar name.
std::vector<const Rule*> idleRules(std::span<const Rule> rules, const std::vector<std::string>& channels);
std::string idleText(const Rule& rule, const std::vector<std::string>& channels);

// Demands for a channel on both sides.
struct ChannelDemands {
    std::span<const Rule> rules{};     // each demands the channels that it names
    std::vector<std::string> names{};  // --channels: these
    bool all = false;                  // --strict: every channel
};
// For a channel of `owner` alone, adds a line to `failures` if it is demanded on both sides, else to `notes`.
void evaluateOneSided(const std::string& channel, const std::string& owner, const ChannelDemands& demands,
                      std::vector<std::string>& failures, std::vector<std::string>& notes);

// Throws std::runtime_error, one line, if a rule names a single channel that is not known.
void checkChannels(std::span<const Rule> rules, const std::vector<std::string>& known);

// Reads a tolerance file (tolerances.schema.json). Every rule has a reason. Throws std::runtime_error, one
// line: "FILE: rule 2: unknown metric maxx; use one of ...".
std::vector<Rule> readRules(const std::filesystem::path& file);
std::vector<Rule> rulesFromJson(std::string_view text, const std::string& name);

}  // namespace diptych
