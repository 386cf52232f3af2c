// SPDX-License-Identifier: MIT
// The tabs at the side: verdict, settings, scene, pixel, cost; below them both paths' times and memory.
#pragma once

#include "compare/viewer/interface/interface_state.h"

namespace diptych::viewer {

void drawPanels(InterfaceState& state, const Contents& contents, const CanvasRect& rect, float scale);

}  // namespace diptych::viewer
