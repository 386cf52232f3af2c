// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/extras.h"
#include "shared/scene/gltf/resources.h"

#include <tiny_gltf.h>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::gltf {

// A file that has come through the door: its model's numbers have the types and ranges of the schema, its
// indices name objects that are there, its buffers are loaded. What lies behind accessors is not checked yet.
struct Document {
    tinygltf::Model model;
    Resources resources;  // images are read from there, when somebody needs them
    LightExtras light_extras;
    MaterialExtras material_extras;
    std::set<std::string> left_out;  // extensions that are not read
    std::vector<std::string> notes;  // what was repaired or left out
};

// The door. Checked before anything is believed: the container's lengths, the size and nesting of the JSON,
// the version, what the file requires, and the schema (gltf_schema.h). tinygltf then parses what the schema
// left, without reading a file. `folder` holds the buffers and images; empty: data URIs only. Throws
// std::runtime_error without the file's name.
Document open(std::vector<unsigned char> bytes, const std::filesystem::path& folder);

}  // namespace diptych::gltf
