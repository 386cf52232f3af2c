// SPDX-License-Identifier: MIT
// Metrics of rows in which deferred lighting chooses the samples to shade.
#pragma once

#include "compare/experiment/errors.h"

#include <array>

namespace diptych::tradeoff {

// Fractions are of pixels with a surface. Exact: the same Settings with --msaa-edges exact.
inline constexpr std::array sampleFigures{
    experiment::NamedMetric{"shaded", "shaded",
                            "mean number of shaded sample groups per pixel: at most 1 + 3 f with 4 samples"},
    experiment::NamedMetric{"edges", "edges", "f: fraction of pixels with more than one shaded group"},
    experiment::NamedMetric{"differing", "differ",
                            "fraction of pixels whose lit differs from exact's in any bit"},
    experiment::NamedMetric{
        "elsewhere", "elsewhere",
        "fraction of pixels that differ although no fewer groups are shaded than with exact: 0 "
        "unless something is wrong"},
};
using SampleShares = std::array<double, sampleFigures.size()>;

}  // namespace diptych::tradeoff
