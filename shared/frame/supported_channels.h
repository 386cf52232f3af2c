// SPDX-License-Identifier: MIT
// Paths that support a channel, by Settings.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/settings.h"

#include <string_view>

namespace diptych {

// Whether the reference supports the channel: it describes the scene, not how a path works.
bool isSupportedByReference(const DebugMode& mode);

// Why a Frame of these Settings does not support the channel, and what does; text for a message, else
// empty.
std::string_view unsupportedReason(const Settings& settings, const DebugMode& mode);

}  // namespace diptych
