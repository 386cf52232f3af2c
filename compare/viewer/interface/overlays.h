// SPDX-License-Identifier: MIT
// Overlays of the shown images: panel titles, the wipe line, colour legends, pixel values, lights and the
// chosen pixel.
#pragma once

#include "compare/viewer/interface/interface_state.h"

#include <vector>

namespace diptych::viewer {

// Draws all overlays over the shown images, which must exist. `scale`: of the interface.
void drawOverlays(const InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                  const std::vector<PanelRect>& panel_rects, float scale);

}  // namespace diptych::viewer
