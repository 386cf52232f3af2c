// SPDX-License-Identifier: MIT
// Positions labels of points without overlap.
#pragma once

#include <vector>

namespace diptych {

struct PlotBox {
    double left, top, right, bottom;  // edges; y grows downwards
};

// A name beside a point; lengths are in the drawing's own units.
struct Label {
    double x = 0, y = 0;           // its point
    double width = 0, height = 0;  // size of its text
};

// A position for each label, inside `area`: beside its point, preferably above right, or further away if
// that is taken. Labels never overlap if one of eight directions at six distances is free. They cover
// `marks` only if nothing else is free.
std::vector<PlotBox> positionLabels(const std::vector<Label>& labels, const std::vector<PlotBox>& marks,
                                    const PlotBox& area);

}  // namespace diptych
