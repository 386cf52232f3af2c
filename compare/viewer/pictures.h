// SPDX-License-Identifier: MIT
// From two Frames to the panels of the window.
#pragma once

#include "compare/viewer/shown.h"
#include "shared/frame/frame.h"

#include <array>
#include <optional>

namespace diptych::viewer {

// The exposure that a picture of `look` gets: of the left Frame's lit, or the right one's where that has
// none.
Exposure exposureOf(const Frame& left, const Frame& right, const Look& look);

// Panels, difference, scale and the top of a heat map from the Frames that stand left and right, equal in
// size or not: then there is no difference, and it is said why. Throws nothing for a channel that a Frame
// lacks.
void makePictures(const Frame& left, const Frame& right, const Look& look, const Exposure& exposure,
                  Shown& shown);

// The difference of `right`, the test, from `left`, the baseline, as `look` asks for it.
DifferencePanel differenceOf(const Frame& left, const Frame& right, const Look& look);

// t in [-1, 1]: blue below 0, black, orange above, by the square root of its size as errorColor() is used, so
// that small differences are seen too.
std::array<std::uint8_t, 3> signedColor(double t);

}  // namespace diptych::viewer
