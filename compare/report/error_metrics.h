// SPDX-License-Identifier: MIT
// The distribution of a channel's errors: a histogram of their sizes, and the positions of the largest.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/image/image.h"

#include <cstdint>
#include <vector>

namespace diptych {

// Pixels by the logarithm of their error. Bin i has errors in [edge(i), edge(i + 1)). The last bin
// includes its upper edge; the first also has all smaller errors.
struct ErrorHistogram {
    int first_decade = 0;     // edge(0) is 10^first_decade
    int bins_per_decade = 0;  // 0: no error is finite and above 0
    std::vector<std::uint64_t> bins;
    std::uint64_t equal = 0, infinite = 0;  // not in any bin
    std::uint64_t smaller = 0;              // number of errors in bin 0 below edge(0)

    double edge(std::size_t bin) const;
};

// Over the covered pixels; at most the twelve decades below the largest error.
ErrorHistogram errorHistogram(const Image& errors, const Coverage& coverage);

struct WorstPixel {
    int x = 0, y = 0;
    double error = 0;  // may be infinite
};

// The largest errors in descending order, each at least `spacing` pixels in x or y from those before it, so
// that one spot is listed once. Equal errors are listed row by row. If not negative, (first_x, first_y)
// comes first, even if other errors became equal to it by rounding to float32.
std::vector<WorstPixel> worstPixels(const Image& errors, std::size_t max, int spacing, int first_x = -1,
                                    int first_y = -1);

}  // namespace diptych
