// SPDX-License-Identifier: MIT
// Which Settings a sweep draws, which it skips, and why.
#pragma once

#include "shared/frame/settings.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::tradeoff {

// A Setting by its option, and a value in words for Settings::set().
using Choice = std::pair<std::string, std::string>;

// Every combination of these values of these Settings; of none, the given Settings alone.
using Grid = std::vector<std::pair<std::string, std::vector<std::string>>>;

struct SweepSkip {
    std::vector<Choice> tried;
    std::string reason;
};

struct SweepRows {
    std::vector<Settings> rows;  // each picture once, in the order in which it was first asked for
    std::vector<SweepSkip> skips;
};

// The grids of a sweep without --grid: for each path that can be drawn, every Setting that it reads is varied
// by itself, and the pairs of sweepPairs() together.
std::vector<Grid> usualGrids(const Settings& given);

// Combinations that have no meaning or cannot be drawn become skips. So does a value that its path
// ignores; the row is then drawn without it. Throws std::runtime_error where nothing is left to draw, or more
// than mostCombinations are asked for.
SweepRows makeSweepRows(const Settings& given, const std::vector<Grid>& grids);
inline constexpr std::size_t mostCombinations = 10'000;

// The same without the rows that `problem` gives a reason against, such as a format that a device lacks; they
// become skips. Throws std::runtime_error where nothing is left.
SweepRows withoutRefused(SweepRows sweep, const Settings& given,
                         const std::function<std::optional<std::string>(const Settings&)>& problem);

// What the reference of the rows follows: the given Settings, but with shadows where any row has them. A
// sweep over shadows is held against the shadowed truth, one over compensations of light between microfacets
// against the walk.
Settings truthFor(const Settings& given, const std::vector<Settings>& rows);

// Skips of one reason: which values of which Settings, or which combinations, in words.
struct SkipGroup {
    std::string reason;
    std::vector<std::string> tried;  // "assign tiled|clustered"
};
std::vector<SkipGroup> groupsOf(const std::vector<SweepSkip>& skips);

// The Settings of a row that differ from `given`. The path comes first and is always included.
std::vector<Choice> choicesOf(const Settings& row, const Settings& given);
std::string inWords(const std::vector<Choice>& choices);  // "deferred, gbuffer compact"

}  // namespace diptych::tradeoff
