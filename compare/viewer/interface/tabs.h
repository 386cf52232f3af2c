// SPDX-License-Identifier: MIT
// The larger tabs of the panels.
#pragma once

#include "compare/viewer/interface/interface_state.h"

namespace diptych::viewer {

void verdictTab(InterfaceState& state, const Contents& contents);
void settingsTab(InterfaceState& state);
void sceneTab(InterfaceState& state, const Contents& contents);

}  // namespace diptych::viewer
