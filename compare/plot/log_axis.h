// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace diptych {

struct Tick {
    double value = 0;
    std::string text;  // empty: a minor one
};

// A logarithmic axis that holds values above 0, with a margin on either side.
class LogAxis {
public:
    // Only finite values above 0 count; without any the axis goes from 0.1 to 1.
    explicit LogAxis(const std::vector<double>& values);

    double low() const { return low_; }
    double high() const { return high_; }
    // From 0 (low) to 1 (high); values beyond are clamped.
    double place(double value) const;
    // Powers of ten where at least two of them are in view, with minor ones between; else 1, 2 and 5 times
    // them; else round steps.
    std::vector<Tick> ticks() const;

private:
    double low_ = 0.1, high_ = 1;
};

}  // namespace diptych
