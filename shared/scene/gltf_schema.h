// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <set>
#include <string>

namespace diptych::gltf {

// Makes a document what its schema says before any parser believes it: what is read has the right type, lies
// in its range and names objects that are there, what is not read (extras, unknown extensions) is gone, whole
// numbers written as 3.0 are whole, names hold no control characters. Returns the extensions that were met
// and taken out. Throws std::runtime_error: "accessor 3: count is \"36\", not a whole number". Source:
// Khronos, glTF 2.0 Specification, 2021, section 5 and the extensions' own texts.
std::set<std::string> applySchema(nlohmann::json& document);

}  // namespace diptych::gltf
