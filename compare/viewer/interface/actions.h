// SPDX-License-Identifier: MIT
// Actions of keys that change only the interface's state: they need no window, camera or drawing thread.
#pragma once

#include "compare/viewer/interface/interface_state.h"
#include "compare/viewer/interface/keys.h"

#include <filesystem>
#include <optional>
#include <string>

namespace diptych::viewer {

// Applies the action. Returns a message for the user, or an empty one; nothing for other actions.
std::optional<std::string> actOnState(const KeyPress& pressed, bool shift, const Contents& contents,
                                      InterfaceState& state);

// Shows a dropped image by Diptych on the left, or lights the scene with a dropped environment. Returns a
// message for the user; nothing for a scene, which the caller reads.
std::optional<std::string> openDropped(const std::filesystem::path& file, InterfaceState& state);

}  // namespace diptych::viewer
