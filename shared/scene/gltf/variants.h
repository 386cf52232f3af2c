// SPDX-License-Identifier: MIT
// KHR_materials_variants (Khronos, glTF 2.0 extensions): named choices of materials for primitives.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace diptych::gltf {

struct Variants {
    std::vector<std::string> names;  // by index; may be empty
    int chosen = -1;                 // -1: none, primitives keep their own materials
    std::vector<std::string> notes;
};

// Removes the extension from `document`, which need not be checked against the schema, and gives each
// primitive the material that it maps to the variant `choice`, an index or a name; empty: none. A faulty
// mapping is omitted with a note. Throws std::runtime_error if `choice` does not select one variant.
Variants takeVariants(nlohmann::json& document, const std::string& choice);

}  // namespace diptych::gltf
