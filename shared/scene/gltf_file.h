// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace tinygltf {
class Model;
}

namespace diptych::gltf {

// The door: everything about a file that is checked before its contents are believed. The container's
// lengths, the nesting of its JSON, the version, that every URI stays in the file's folder and that
// what the file requires is built. Then tinygltf parses it: buffers are loaded, images are left encoded.
// Indices between objects are not checked here. Throws std::runtime_error without the file's name.
tinygltf::Model openFile(const std::filesystem::path& file);

bool isBuilt(std::string_view extension);

}  // namespace diptych::gltf
