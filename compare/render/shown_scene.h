// SPDX-License-Identifier: MIT
// A scene as a picture of it shows it: with the environment that its Settings ask for.
#pragma once

#include "compare/run/progress.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"

#include <string>

namespace diptych {

// Loads the scene (shared/scene/load.h) with the environment of the Settings; reports to `progress`. Throws
// std::runtime_error, one line, naming the file.
Scene loadShown(const std::string& where, const Settings& settings, const Stage& progress);

}  // namespace diptych
