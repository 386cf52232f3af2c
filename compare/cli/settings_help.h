// SPDX-License-Identifier: MIT
// Which Settings a command's --help names: those of which it can draw more than the default.
#pragma once

#include "shared/frame/settings.h"

#include <string>

namespace diptych::cli {

// Whether `command` ("compare") can draw any value of `field` but its default. `render` draws the reference,
// too; the others draw both paths, and the reference at most beside them.
bool isDrawnBy(const std::string& command, const Field& field);

}  // namespace diptych::cli
