// SPDX-License-Identifier: MIT
// Helpers for reading JSON that is not yet checked against the schema.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>

namespace diptych::gltf {

// The member `key`; nullptr if it is absent or `value` is not an object.
const nlohmann::json* memberOf(const nlohmann::json& value, const char* key);

// The array at a JSON pointer; empty if there is none.
const nlohmann::json& arrayAt(const nlohmann::json& document, const char* place);

// Removes the extension's object from `owner` and returns it; null if absent.
nlohmann::json takeExtension(nlohmann::json& owner, const char* name);

// Returns `value` if it is an index below `count`; otherwise throws std::runtime_error that begins with
// `who`.
int indexBelow(const nlohmann::json& value, std::size_t count, const std::string& who);

}  // namespace diptych::gltf
