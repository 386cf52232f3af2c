// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

class JsonFields;

// Reads a file of lights, { "lights": [ { "type": ... }, ... ] }, in world space. Defaults are those of
// KHR_lights_punctual and of Light:
//
//   all           "type", "name", "position": [x, y, z] m, "direction": [x, y, z], "color": [r, g, b],
//                 "intensity" (directional: lux; point, spot: cd; rect, disc, tube: cd/m^2), "range": m,
//                 "unit" (must be the unit of "intensity"), "extras" (ignored). Directional lights ignore
//                 position and range, point lights ignore the direction. "importance": "auto", "important"
//                 or "not_important", for --assign per_object
//   point, spot   "shadow": true, requests a shadow
//   directional   "angle": rad, its angular diameter; does not change the illuminance
//   spot          "spot": { "innerConeAngle": rad, "outerConeAngle": rad }; both may also be beside "type"
//   rect          "size": [along the axis, perpendicular to it] m, "axis", "twoSided"
//   disc          "radius": m, "twoSided"
//   tube          "length": m, along the axis, "radius": m, "axis"
//
// A rect's axis is projected to be perpendicular to its direction. The default axis is horizontal (y = 0)
// and points to the right of a viewer who looks along the direction with +Y up. If the direction is +Y or
// -Y, it is +X. Misspelt keys and keys of other light types are errors. Throws std::runtime_error, one
// line: "FILE: light 3: range: ...".
std::vector<Light> readLights(const std::filesystem::path& file);
std::vector<Light> lightsFromJson(std::string_view text, const std::string& name);

// The value of "type", such as "rect".
std::string_view nameOf(LightKind kind);

// Reads one light object. Throws std::runtime_error: "WHO: range: ...".
Light lightFromJson(const nlohmann::json& object, const std::string& who);
// The inverse of lightFromJson(), without `importance`.
nlohmann::ordered_json jsonOf(const Light& light);
// "angle" of a directional light, rad, 0 to pi; 0 if the key is absent.
float sunAngle(const JsonFields& fields);
// "importance"; automatic if the key is absent.
Importance importanceOf(const JsonFields& fields);

}  // namespace diptych
