// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace diptych {

struct Tick {
    double value = 0;
    std::string text;  // empty: a minor tick
};

// A logarithmic axis for values above 0, with a margin at both ends.
class LogAxis {
public:
    // Only finite values above 0 count; without any, the axis is 0.1 to 1.
    explicit LogAxis(const std::vector<double>& values);

    double low() const { return low_; }
    double high() const { return high_; }
    // Position from 0 (low) to 1 (high), clamped.
    double place(double value) const;
    // Powers of ten if at least two are visible, with minor ticks between them; else 1, 2 and 5 times
    // powers of ten; else even steps.
    std::vector<Tick> ticks() const;

private:
    double low_ = 0.1, high_ = 1;
};

}  // namespace diptych
