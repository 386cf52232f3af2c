// SPDX-License-Identifier: MIT
// Converts two Frames to the panels of the window.
#pragma once

#include "compare/viewer/drawing/result.h"
#include "shared/frame/frame.h"

#include <array>
#include <optional>

namespace diptych::viewer {

// The exposure for `view_options`: from the left Frame's lit, or the right one's if the left has none.
Exposure exposureOf(const Frame& left, const Frame& right, const ViewOptions& view_options);

// Makes panels, difference, scale and heat-map top from the left and right Frames. If their sizes differ,
// there is no difference, and its text says why. A channel that a Frame lacks is not an error.
void makeImages(const Frame& left, const Frame& right, const ViewOptions& view_options,
                const Exposure& exposure, DrawnView& shown);

// The difference of `right`, the test, from `left`, the baseline, as chosen in `view_options`.
DifferencePanel differenceOf(const Frame& left, const Frame& right, const ViewOptions& view_options);

// t in [-1, 1]: blue below 0, black, orange above. Brightness is the square root of |t|, as in error
// images, so that small differences are visible.
std::array<std::uint8_t, 3> signedColor(double t);

}  // namespace diptych::viewer
