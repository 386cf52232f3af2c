// SPDX-License-Identifier: MIT
// The figures of rows whose deferred lighting chooses which of a pixel's samples it shades.
#pragma once

#include <array>
#include <string_view>

namespace diptych::tradeoff {

struct SampleFigure {
    std::string_view name, title, means;
};
// Shares are of the pixels that show a surface. Exact: the same Settings with --msaa-edges exact.
inline constexpr std::array sampleFigures{
    SampleFigure{"shaded", "shaded",
                 "Surfaces that are shaded at such a pixel, at the mean: 1 + 3 f at most, with 4 samples"},
    SampleFigure{"edges", "edges", "f: share of the pixels where more than one is shaded"},
    SampleFigure{"differing", "differ", "share of the pixels whose lit is not exact's, by any bit"},
    SampleFigure{"elsewhere", "elsewhere",
                 "share that differs although no fewer Surfaces are shaded there than by exact: 0, unless "
                 "something is wrong"},
};
using SampleShares = std::array<double, sampleFigures.size()>;

}  // namespace diptych::tradeoff
