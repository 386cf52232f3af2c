// SPDX-License-Identifier: MIT
// Where names of points stand, so that none covers another.
#pragma once

#include "compare/plot/drawing.h"

#include <vector>

namespace diptych {

// A name beside a point; lengths are in the drawing's own units.
struct Label {
    double x = 0, y = 0;           // its point
    double width = 0, height = 0;  // room for its words
};

// A place for each label, inside `area`: beside its point, first above on the right, or as much further away
// as others take the room. `marks` are what a label should not cover, though it may where nothing else is
// left; another label is never covered as long as eight directions at six distances have a place.
std::vector<PlotBox> placeLabels(const std::vector<Label>& labels, const std::vector<PlotBox>& marks,
                                 const PlotBox& area);

}  // namespace diptych
