// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace diptych::gltf {

// Makes a document what its schema says before any parser believes it: what is read has the right type, lies
// in its range and names objects that are there, what is not read (extras, unknown extensions) is gone, whole
// numbers written as 3.0 are whole, names hold no control characters. What is broken and no scene needs is
// left out. Throws std::runtime_error: "accessor 3: count is \"36\", not a whole number". Source:
// Khronos, glTF 2.0 Specification, 2021, section 5 and the extensions' own texts.
struct Schema {
    std::set<std::string> extensions;              // that were met, or are in extensionsUsed
    std::map<std::string, std::string> misplaced;  // where one of them stands and is not looked for
    std::vector<std::string> notes;                // what was repaired or left out
};
Schema applySchema(nlohmann::json& document);

}  // namespace diptych::gltf
