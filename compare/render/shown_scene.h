// SPDX-License-Identifier: MIT
// Loads a scene with the material variant and the environment that its Settings request.
#pragma once

#include "compare/run/progress.h"
#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"

#include <string>

namespace diptych {

// Loads the scene (shared/scene/load.h), the variant and the environment of the Settings; reports to
// `progress`. Throws std::runtime_error, one line, naming the file.
Scene loadShown(const std::string& where, const Settings& settings, const Stage& progress);

}  // namespace diptych
