// SPDX-License-Identifier: MIT
// Tolerances as data: the rules of a tolerance file and what they decide about measured figures. Modelled on
// Filament's renderdiff presets.
#pragma once

#include "compare/verdict/criterion.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// One number that a comparison of two images of a channel yields, and that a rule may bound.
struct Figure {
    std::string_view name;
    bool more_is_better;       // psnr, ssim: a bound is the least that passes
    std::string_view meaning;  // formula, unit and source, one line
};
std::span<const Figure> figures();
const Figure* findFigure(std::string_view name);  // nullptr where there is none

inline constexpr const char* FAILING = "failing";

// A figure, or the share of pixels, 0 to 1, whose error in the channel's metric is above `above`.
struct Quantity {
    std::string figure;  // FAILING for the share
    double above = 0;
};
// Returns the measured value of a quantity; empty where it is not defined for the channel (flip of an id).
using Measured = std::function<std::optional<double>(const Quantity&)>;

// A bound on one quantity, or several conditions of which all or any must hold.
struct Condition {
    enum class Kind { bound, all, any };
    Kind kind = Kind::all;
    Quantity quantity;
    double limit = 0;  // at most, or at least where more is better
    std::vector<Condition> parts;
};
// Why the condition does not hold, e.g. "max 0.005 exceeds 0.0037"; empty if it holds. A quantity that is NaN
// or not defined never holds.
std::optional<std::string> violation(const Condition& condition, const Measured& measured);

// The bound that decides: of several that must all hold the one that uses most of its limit, of alternatives
// the one that uses least. Empty where nothing is bounded or the figure is not defined. Its pixels are not
// counted here.
std::optional<Criterion> decidingBound(const Condition& condition, const Measured& measured);

// Whether any part of the condition bounds the figure.
bool boundsFigure(const Condition& condition, std::string_view figure);
// The least upper bound on the figure that holds in every case; empty if there is none.
std::optional<double> boundOn(const Condition& condition, std::string_view figure);

// "max <= 0.0037 and (flip <= 0.02 or psnr >= 40)"
std::string conditionText(const Condition& condition);

struct Rule {
    std::string channel = "*";      // a name, or with * and ? several
    std::string scene = "*";        // likewise, as the command line names it; of compare
    Condition fail;                 // what must hold, or the channel fails
    std::optional<Condition> warn;  // what must hold, or there is a warning
    std::string because;
    std::string origin;  // "tolerances.json, rule 3"; printed with what it decided
};

enum class Level { pass, warn, fail };
std::string_view nameOf(Level level);

struct Decision {
    Level level = Level::pass;
    const Rule* rule = nullptr;
    std::string reason;                    // of a warning or failure; empty otherwise
    std::optional<Criterion> criterion{};  // the bound that decided, if the rule has one
};
Decision decide(const Rule& rule, const Measured& measured);

// The last rule whose pattern the channel matches, as in a list of exceptions; nullptr: none.
const Rule* ruleFor(std::span<const Rule> rules, std::string_view channel);

// Those that are about the scene.
std::vector<Rule> rulesOfScene(std::span<const Rule> rules, std::string_view scene);

// Whether the rule is about channels that it names, and not about all ("*").
bool namesChannels(const Rule& rule);

// Whether the rule's channel is a pattern (* and ?) and not one name.
bool isPattern(const Rule& rule);

// The rules that match none of the channels, and the line that says so of one, with the name that was meant.
std::vector<const Rule*> idleRules(std::span<const Rule> rules, const std::vector<std::string>& channels);
std::string idleText(const Rule& rule, const std::vector<std::string>& channels);

// Throws std::runtime_error, one line, over a rule for one channel by a name that is none of the known.
void checkChannels(std::span<const Rule> rules, const std::vector<std::string>& known);

// A tolerance file, as tolerances.schema.json describes it. Every rule names its reason. Throws
// std::runtime_error, one line: "FILE: rule 2: no such figure maxx; there are ...".
std::vector<Rule> readRules(const std::filesystem::path& file);
std::vector<Rule> rulesFromJson(std::string_view text, const std::string& name);

}  // namespace diptych
