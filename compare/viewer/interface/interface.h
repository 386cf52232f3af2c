// SPDX-License-Identifier: MIT
// Everything that Dear ImGui draws: the bar, titles, legends and values over the images, the footer and
// the help.
#pragma once

#include "compare/viewer/interface/interface_state.h"

#include <vector>

namespace diptych::viewer {

// Draws the interface and applies user actions to the state. `panel_rects`: the panels in the canvas.
void drawInterface(InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                   const std::vector<PanelRect>& panel_rects, double scale);

}  // namespace diptych::viewer
