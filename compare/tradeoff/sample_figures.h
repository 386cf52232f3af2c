// SPDX-License-Identifier: MIT
// Multisampling: how many samples deferred lighting shades, and how their choice changes the image.
#pragma once

#include "compare/tradeoff/figure_table.h"
#include "shared/frame/frame.h"

#include <optional>

namespace diptych::tradeoff {

// The Settings to compare with: --msaa-edges exact shades all samples that differ.
std::optional<Settings> exactEdges(const Settings& settings);  // empty if samples are not chosen

// Empty if a Frame lacks shaded_samples or lit.
std::optional<SampleShares> sampleSharesOf(const Frame& exact, const Frame& frame);

// Rows with a choice of samples; may be empty.
FigureTable sampleTable(const Tradeoff& tradeoff);

}  // namespace diptych::tradeoff
