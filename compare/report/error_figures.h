// SPDX-License-Identifier: MIT
// How the errors of a channel are distributed: a histogram of their sizes, and where in the picture the
// largest are.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/image/image.h"

#include <cstdint>
#include <vector>

namespace diptych {

// Pixels by the logarithm of their error. Bin i holds errors from edge(i) up to but not including edge(i +
// 1); the last one also holds its upper edge, the first one also whatever is smaller.
struct ErrorHistogram {
    int first_decade = 0;     // edge(0) is 10^first_decade
    int bins_per_decade = 0;  // 0: no error is finite and above 0
    std::vector<std::uint64_t> bins;
    std::uint64_t equal = 0, infinite = 0;  // beside the bins
    std::uint64_t smaller = 0;              // of bin 0, those below edge(0)

    double edge(std::size_t bin) const;
};

// Over the covered pixels. From the largest error down to the smallest, at most twelve decades.
ErrorHistogram errorHistogram(const Image& errors, const Coverage& coverage);

struct WorstPixel {
    int x = 0, y = 0;
    double error = 0;  // may be infinite
};

// The largest errors, largest first, each at least `apart` pixels in x or y from those before it, so that one
// spot is listed once. Equal errors are listed row by row; (first_x, first_y), if not negative, comes first
// even if rounding to float32 made other errors equal to it.
std::vector<WorstPixel> worstPixels(const Image& errors, std::size_t most, int apart, int first_x = -1,
                                    int first_y = -1);

}  // namespace diptych
