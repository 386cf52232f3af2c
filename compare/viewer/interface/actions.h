// SPDX-License-Identifier: MIT
// Actions that change only the interface's state: they need no window, camera or drawing thread.
#pragma once

#include "compare/viewer/interface/interface_state.h"
#include "compare/viewer/interface/keys.h"

#include <filesystem>
#include <optional>
#include <string>

namespace diptych::viewer {

// Applies the action; what needs the window stands in `state.requests`. Returns a message for the user, or an
// empty one; nothing for other actions.
std::optional<std::string> actOnState(const KeyPress& pressed, bool shift, const Contents& contents,
                                      InterfaceState& state);

// Shows a dropped image by Diptych on the left, lights the scene with a dropped environment, or opens a
// dropped scene. Returns a message for the user, or an empty one.
std::string openDropped(const std::filesystem::path& file, InterfaceState& state);

// Makes images as large as the canvas shows them, if they follow it; drops an inspected pixel outside them.
// Returns whether their size changed.
bool fitToCanvas(const CanvasRect& canvas, InterfaceState& state);

}  // namespace diptych::viewer
