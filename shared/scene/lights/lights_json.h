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

// Reads a file of lights, { "lights": [ { "type": ... }, ... ] }, in world space. README.md has the keys;
// defaults are those of KHR_lights_punctual and of Light. Misspelt keys and keys of other light types are
// errors. Throws std::runtime_error, one line: "FILE: light 3: range: ...".
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
