// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/gltf/image_light.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/gltf/resources.h"
#include "shared/scene/gltf/variants.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace diptych::gltf {

// A validated file: values have the types and ranges of the schema, indices refer to existing objects,
// buffers are loaded. Accessor elements are not yet checked.
struct Document {
    Model model;
    Resources resources;  // loads images on demand
    ImageLights image_lights;
    Variants variants;                         // primitives have the chosen one's materials
    std::set<std::string> ignored_extensions;  // extensions that the file uses but this reader ignores
    std::map<std::size_t, std::string> broken_meshes = {};  // why each was omitted
    std::vector<std::string> notes;                         // repairs and omissions, one line each
};

// Loads a file. Checks before use: container lengths, size and nesting of the JSON, version, required
// extensions, and the schema (schema.h). tinygltf then parses its part of the document without file access.
// `folder` has the buffers and images; if empty, only data URIs are read. `variant`: see takeVariants().
// Throws std::runtime_error without the file's name.
Document open(std::vector<unsigned char> bytes, const std::filesystem::path& folder,
              const std::string& variant);

// Only the checks of open() that read no data: container, JSON, version, required extensions, variant.
void checkHeader(const std::vector<unsigned char>& bytes, const std::string& variant);

}  // namespace diptych::gltf
