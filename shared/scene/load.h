// SPDX-License-Identifier: MIT
// Loads a Scene by name: a glTF file or a built-in scene.
#pragma once

#include "shared/scene/model/load_progress.h"
#include "shared/scene/model/scene.h"

#include <cstdint>
#include <string>

namespace diptych {

// `where` is "builtin:NAME[?key=value&...]" or a .gltf or .glb file. `progress` is called during loading.
// `variant` is the index or name of a material variant of the file; empty: primitives' own materials. Throws
// std::runtime_error: one line that names file, object and fault.
Scene loadScene(const std::string& where, const LoadProgress& progress = {}, const std::string& variant = "");

// Checks quickly whether `where` is a scene with the variant, without reading its data: the file exists, and
// its container lengths, JSON, version and required extensions are valid. Throws as loadScene().
void checkScene(const std::string& where, const std::string& variant = "");

// Estimated memory that the parameters of a built-in scene ask for; 0 for files.
std::uint64_t askedBytes(const std::string& where);

}  // namespace diptych
