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

// { "lights": [ { "type": ... }, ... ] }, in world space, with the defaults of KHR_lights_punctual and of
// Light:
//
//   all           "type", "name", "position": [x, y, z] m, "direction": [x, y, z], "color": [r, g, b],
//                 "intensity" (directional: lux; point, spot: cd; rect, disc, tube: cd/m^2), "range": m,
//                 "extras" (not read). A directional light's position and range, a point's direction count
//                 for nothing.
//                 "importance": "auto", "important" or "not_important", of --assign per_object
//   directional   "angle": rad, the diameter of its disc; the illuminance stays what it is
//   spot          "spot": { "innerConeAngle": rad, "outerConeAngle": rad }, which may stand beside the type
//   rect          "size": [along the axis, across it] m, "axis", "twoSided"
//   disc          "radius": m, "twoSided"
//   tube          "length": m, along the axis, "radius": m, "axis"
//
// A rect's axis is made to stand at right angles to its direction. Without an axis it is level (y = 0), to
// the right of who looks along the direction with +Y up; +X where the direction is +Y or -Y. A key of another
// type is an error, as a misspelt one is. Throws std::runtime_error, one line: "FILE: light 3: range: ...".
std::vector<Light> readLights(const std::filesystem::path& file);
std::vector<Light> lightsFromJson(std::string_view text, const std::string& name);

// One of these objects. Throws std::runtime_error: "WHO: range: ...".
Light lightFromJson(const nlohmann::json& object, const std::string& who);
// "angle" of a directional light, 0 to pi; 0 where there is none.
float sunAngle(const JsonFields& fields);
// "importance"; automatic where there is none.
Importance importanceOf(const JsonFields& fields);

}  // namespace diptych
