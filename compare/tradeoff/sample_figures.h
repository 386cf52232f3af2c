// SPDX-License-Identifier: MIT
// With several samples a pixel: how many of them deferred lighting shades, and what its choice of them
// changes.
#pragma once

#include "compare/tradeoff/figure_table.h"
#include "shared/frame/frame.h"

#include <optional>

namespace diptych::tradeoff {

// What a Frame is held against: the same Settings with --msaa-edges exact, which shades whatever differs.
std::optional<Settings> exactEdges(const Settings& settings);  // nothing where samples are not chosen

// Nothing where a Frame lacks shaded_samples or lit.
std::optional<SampleShares> sampleSharesOf(const Frame& exact, const Frame& frame);

// The rows of a sweep that choose samples. Empty where there are none.
FigureTable sampleTable(const Tradeoff& tradeoff);

}  // namespace diptych::tradeoff
