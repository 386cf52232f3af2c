// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// { "lights": [ { "type": "point|spot|directional", "name", "position": [x, y, z] m, "direction": [x, y, z],
//   "color": [r, g, b], "intensity": cd, directional: lux, "range": m, "spot": { "innerConeAngle": rad,
//   "outerConeAngle": rad } } ] }, in world space, with the defaults of KHR_lights_punctual; the cone angles
// may also stand beside the type. Throws std::runtime_error, one line: "FILE: light 3: range: ...".
std::vector<Light> readLights(const std::filesystem::path& file);
std::vector<Light> lightsFromJson(std::string_view text, const std::string& name);

}  // namespace diptych
