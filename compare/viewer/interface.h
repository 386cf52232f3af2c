// SPDX-License-Identifier: MIT
// All that Dear ImGui draws: the bar, titles, legends and values over the pictures, the foot and the help.
#pragma once

#include "compare/viewer/interface_state.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::viewer {

// Draws all of it and changes the state by what was done in it. `places`: of the panels in the canvas.
void drawInterface(InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                   const std::vector<PanelPlace>& places, double scale);

// Text over a picture, with a dark edge, so that it can be read on any.
void drawOutlined(float x, float y, std::uint32_t color, const std::string& text);

}  // namespace diptych::viewer
