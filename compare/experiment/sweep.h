// SPDX-License-Identifier: MIT
// Settings that a sweep renders, and those it skips, with reasons.
#pragma once

#include "compare/experiment/change.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::experiment {

// The product of these values; an empty grid is the given Settings.
using Grid = std::vector<std::pair<std::string, std::vector<std::string>>>;

struct SweepSkip {
    std::vector<Change> tried;
    std::string reason;
};

struct SweepRows {
    std::vector<Settings> rows;  // distinct, in order of their first request
    std::vector<SweepSkip> skips;
};

// Default grids without --grid. For each path, varies every Setting that it reads alone, and the pairs of
// sweepPairs() together.
std::vector<Grid> defaultGrids(const Settings& requested);

// Invalid and unsupported combinations become skips. So does a value that its path ignores; the row is
// rendered without it. Throws std::runtime_error if no row is left or there are more than
// maxCombinations.
SweepRows makeSweepRows(const Settings& requested, const std::vector<Grid>& grids);
inline constexpr std::size_t maxCombinations = 10'000;

// Moves rows for which `problem` returns a reason, such as an unsupported format, to the skips. Throws
// std::runtime_error if no row is left.
SweepRows withoutRefused(SweepRows sweep, const Settings& requested,
                         const std::function<std::optional<std::string>(const Settings&)>& problem);

// Settings of the reference: the given ones, with features of the rows. Shadows are on if any row has
// them. Multiple scattering is the random walk if any row has it. Haze is ray marched if any row does so.
Settings referenceFor(const Settings& requested, const std::vector<Settings>& rows);

// Skips with one reason: values per option, or combinations, as text.
struct SkipGroup {
    std::string reason;
    std::vector<std::string> tried;  // "msaa-edges all|similar"
};
std::vector<SkipGroup> groupsOf(const std::vector<SweepSkip>& skips);

// Settings of a row that differ from `requested`. The path comes first and is always included.
std::vector<Change> changesOf(const Settings& row, const Settings& requested);
std::string describe(const std::vector<Change>& choices);  // "deferred, gbuffer compact"

}  // namespace diptych::experiment
