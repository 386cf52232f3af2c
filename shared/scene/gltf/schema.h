// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace diptych::gltf {

// Checks a document against the schema (properties.h) before it is given to any parser. Afterwards every
// property that is read has the right type, lies in its range and refers to existing objects; everything
// that is not read (extras, unknown extensions) is removed, integers written as 3.0 are integers, names hold
// no control characters, and broken objects that no scene needs are left out. Throws std::runtime_error:
// "accessor 3: count is \"36\", not a whole number". Source: Khronos, glTF 2.0 Specification, 2021, section
// 5 and the extensions' own texts.
struct Schema {
    std::set<std::string> extensions;  // found in objects, or listed in extensionsUsed
    // Extension -> an object that has it although it is not read there.
    std::map<std::string, std::string> misplaced;
    std::map<std::size_t, std::string> broken_meshes;  // why each was left out; a node may name it
    std::vector<std::string> notes;                    // what was repaired or left out, one line each
};
Schema applySchema(nlohmann::json& document);

}  // namespace diptych::gltf
