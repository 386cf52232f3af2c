// SPDX-License-Identifier: MIT
// Which channels a path makes with which Settings.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/settings.h"

#include <string_view>

namespace diptych {

// Whether the reference makes the channel: it is about the scene, not about how a path works.
bool isMadeByReference(const DebugMode& mode);

// Why a Frame of these Settings has no such channel and which has, fit for a message; empty where it has one.
std::string_view notMadeBecause(const Settings& settings, const DebugMode& mode);

}  // namespace diptych
