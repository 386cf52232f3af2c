// SPDX-License-Identifier: MIT
// Interpolation as specified for the table of shared/contract/albedo.h, in double.
#pragma once

#include <algorithm>

namespace diptych {

// Lagrange polynomial through four of `count` samples around `position`, in sample spacings from the first.
template <class Sample>
double cubicAt(double position, int count, const Sample& sample) {
    const int first = std::clamp(static_cast<int>(position) - 1, 0, count - 4);
    double sum = 0;
    for (int i = first; i < first + 4; ++i) {
        double weight = 1;
        for (int j = first; j < first + 4; ++j)
            if (j != i) weight *= (position - j) / (i - j);
        sum += weight * sample(i);
    }
    return sum;
}

}  // namespace diptych
