// SPDX-License-Identifier: MIT
// Metrics of rows in which deferred lighting chooses the samples to shade.
#pragma once

#include <array>
#include <string_view>

namespace diptych::tradeoff {

struct SampleFigure {
    std::string_view name, title, means;
};
// Fractions are of pixels with a surface. Exact: the same Settings with --msaa-edges exact.
inline constexpr std::array sampleFigures{
    SampleFigure{"shaded", "shaded",
                 "mean number of shaded sample groups per pixel: at most 1 + 3 f with 4 samples"},
    SampleFigure{"edges", "edges", "f: fraction of pixels with more than one shaded group"},
    SampleFigure{"differing", "differ", "fraction of pixels whose lit differs from exact's in any bit"},
    SampleFigure{"elsewhere", "elsewhere",
                 "fraction of pixels that differ although no fewer groups are shaded than with exact: 0 "
                 "unless something is wrong"},
};
using SampleShares = std::array<double, sampleFigures.size()>;

}  // namespace diptych::tradeoff
