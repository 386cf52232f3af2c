// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace diptych::gltf {

// Validates a document against the schema (properties.h) before any parser sees it. Afterwards, supported
// properties have valid types and ranges and refer to existing objects. Everything else (unknown extensions,
// extras but ours) is removed. Integers written as 3.0 are integers, and names have no control characters.
// Broken objects that no scene needs are omitted. Throws std::runtime_error: "accessor 3: count is \"36\",
// not a whole number". Source: Khronos, glTF 2.0 Specification, 2021, section 5 and the extensions'
// specifications.
struct Schema {
    std::set<std::string> extensions;  // used by objects
    std::set<std::string> declared;    // listed in extensionsUsed
    // Extension -> an object that has it but does not support it.
    std::map<std::string, std::string> misplaced;
    std::map<std::size_t, std::string> broken_meshes;  // why each was omitted; nodes may still refer to it
    std::vector<std::string> notes;                    // repairs and omissions, one line each
};
Schema applySchema(nlohmann::json& document);

}  // namespace diptych::gltf
