// SPDX-License-Identifier: MIT
// What a team lets differ, as data: a tolerance file's rules, and what they decide about measured figures. In
// the manner of Filament's renderdiff presets.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// One number that a comparison of two images of a channel ends in, and that a rule may bound.
struct Figure {
    std::string_view name;
    bool more_is_better;       // psnr, ssim: a bound is the least that passes
    std::string_view meaning;  // formula, unit and source, one line
};
std::span<const Figure> figures();
const Figure* findFigure(std::string_view name);  // nullptr where there is none

// A figure, or the share of pixels, 0 to 1, whose error in the channel's metric is above `above`.
struct Quantity {
    std::string figure;  // "failing" for the share
    double above = 0;
};
// Gives the measured value of a quantity; nothing where it is not defined for the channel (flip of an id).
using Measured = std::function<std::optional<double>(const Quantity&)>;

// A bound on one quantity, or several conditions of which all or any must hold.
struct Condition {
    enum class Kind { bound, all, any };
    Kind kind = Kind::all;
    Quantity quantity;
    double limit = 0;  // at most, or at least where more is better
    std::vector<Condition> parts;
};
// Why it does not hold, "max 0.005 exceeds 0.0037"; nothing where it does. What is NaN or not defined never
// holds.
std::optional<std::string> violation(const Condition& condition, const Measured& measured);

// Whether it puts a bound on a figure in any case.
bool boundsFigure(const Condition& condition, std::string_view figure);
// The least upper bound that it puts on a figure in every case; nothing: none.
std::optional<double> boundOn(const Condition& condition, std::string_view figure);

// "max <= 0.0037 and (flip <= 0.02 or psnr >= 40)"
std::string conditionText(const Condition& condition);

struct Rule {
    std::string channel = "*";      // a name, or with * and ? several
    Condition fail;                 // what must hold, or the channel fails
    std::optional<Condition> warn;  // what must hold, or it is warned of
    std::string because;
    std::string origin;  // "tolerances.json, rule 3"; printed with what it decided
};

enum class Level { pass, warn, fail };
std::string_view nameOf(Level level);

struct Decision {
    Level level = Level::pass;
    const Rule* rule = nullptr;
    std::string reason;  // of a warning or failure; empty otherwise
};
Decision decide(const Rule& rule, const Measured& measured);

// The last rule whose pattern the channel matches, as in a list of exceptions; nullptr: none.
const Rule* ruleFor(std::span<const Rule> rules, std::string_view channel);

// A line for each rule whose pattern is that of none of the channels.
std::vector<std::string> idleRules(std::span<const Rule> rules, const std::vector<std::string>& channels);

// A tolerance file, as compare/tolerances.schema.json describes it. Every rule names its reason. Throws
// std::runtime_error, one line: "FILE: rule 2: no such figure maxx; there are ...".
std::vector<Rule> readRules(const std::filesystem::path& file);
std::vector<Rule> rulesFromJson(std::string_view text, const std::string& name);

}  // namespace diptych
