// SPDX-License-Identifier: MIT
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/requirements.h"

#include <string>
#include <vector>

namespace diptych {

// One note for each type of light in the scene that the path does not support; the reference supports all.
std::vector<std::string> omittedLights(Path path, const Requirements& needs);

// Lights that cast no shadow although shadows are enabled.
std::vector<std::string> omittedShadows(const std::vector<Light>& lights, const Settings& settings);

}  // namespace diptych
