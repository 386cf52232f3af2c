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

// A file of lights, { "lights": [ { "type": ... }, ... ] }, in world space. Defaults are those of
// KHR_lights_punctual and of Light:
//
//   all           "type", "name", "position": [x, y, z] m, "direction": [x, y, z], "color": [r, g, b],
//                 "intensity" (directional: lux; point, spot: cd; rect, disc, tube: cd/m^2), "range": m,
//                 "unit" (the one said here, or an error), "extras" (not read). A directional light's
//                 position and range and a point light's direction have no effect. "importance": "auto",
//                 "important" or "not_important", for --assign per_object
//   point, spot   "shadow": true, asks to cast one
//   directional   "angle": rad, the diameter of its disc; it does not change the illuminance
//   spot          "spot": { "innerConeAngle": rad, "outerConeAngle": rad }; both may also stand beside "type"
//   rect          "size": [along the axis, across it] m, "axis", "twoSided"
//   disc          "radius": m, "twoSided"
//   tube          "length": m, along the axis, "radius": m, "axis"
//
// A rect's axis is projected to be at right angles to its direction. If no axis is given it is horizontal
// (y = 0), to the right of a viewer who looks along the direction with +Y up; if the direction is +Y or -Y,
// it is +X. A key of another type of light is an error, as is a misspelt one. Throws std::runtime_error, one
// line: "FILE: light 3: range: ...".
std::vector<Light> readLights(const std::filesystem::path& file);
std::vector<Light> lightsFromJson(std::string_view text, const std::string& name);

// "rect": the "type" of such an object.
std::string_view nameOf(LightKind kind);

// Reads one object of such a file. Throws std::runtime_error: "WHO: range: ...".
Light lightFromJson(const nlohmann::json& object, const std::string& who);
// The way back: what lightFromJson() reads as the same light; without its `importance`.
nlohmann::ordered_json jsonOf(const Light& light);
// "angle" of a directional light, 0 to pi; 0 if the key is absent.
float sunAngle(const JsonFields& fields);
// "importance"; automatic if the key is absent.
Importance importanceOf(const JsonFields& fields);

}  // namespace diptych
