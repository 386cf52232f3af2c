// SPDX-License-Identifier: MIT
// Describes an axis of a plot.
#pragma once

#include <string>
#include <vector>

namespace diptych {

// On a logarithmic axis, points at 0 and below have a lane of their own before the axis; on every axis,
// infinite values and NaN have one behind it.
struct PlotAxis {
    std::string name{};
    bool logarithmic = true;
    std::vector<double> shown{};            // visible besides all points and bars
    std::vector<std::string> categories{};  // names of 0, 1, ... at even distances; upwards, 0 is on top
};

}  // namespace diptych
