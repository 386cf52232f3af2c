// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/extras.h"
#include "shared/scene/gltf/image_light.h"
#include "shared/scene/gltf/resources.h"

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::gltf {

// A file that has been checked: the numbers of its model have the types and ranges of the schema, its
// indices name objects that exist, its buffers are loaded. The elements of accessors are not checked yet.
struct Document {
    tinygltf::Model model;
    Resources resources;  // images are read through it when they are needed
    LightExtras light_extras;
    MaterialExtras material_extras;
    ImageLights image_lights;
    std::set<std::string> left_out;  // extensions that the file uses and that are not read
    std::map<std::size_t, std::string> broken_meshes = {};  // why a mesh was left out
    std::vector<std::string> notes;                         // what was repaired or left out, one line each
};

// Loads a file. Nothing in it is trusted before it is checked: the container's lengths, the size and nesting
// of the JSON, the version, the required extensions, and the schema (schema.h). tinygltf then parses the
// document as the schema left it, without reading a file. `folder` holds the buffers and images; empty: only
// data URIs are read. Throws std::runtime_error without the file's name.
Document open(std::vector<unsigned char> bytes, const std::filesystem::path& folder);

// What open() finds wrong before it reads any data: container, JSON, version, required extensions.
void checkHeader(const std::vector<unsigned char>& bytes);

}  // namespace diptych::gltf
