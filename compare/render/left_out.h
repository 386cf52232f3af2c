// SPDX-License-Identifier: MIT
#pragma once

#include "shared/frame/settings.h"
#include "shared/scene/model/scene.h"
#include "shared/scene/requirements.h"

#include <string>
#include <vector>

namespace diptych {

// One note for each kind of light in the scene that the path does not draw yet; the reference draws all.
std::vector<std::string> leftOutLight(Path path, const Requirements& needs);

// What of the lights casts no shadow where shadows are asked for.
std::vector<std::string> leftOutShadows(const std::vector<Light>& lights, const Settings& settings);

}  // namespace diptych
