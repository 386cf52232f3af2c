// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/load_progress.h"
#include "shared/scene/model/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Loads a .gltf or .glb file, version 2.0. `scene` is the index or name of a scene in it. If empty, the
// file's default scene is loaded, or else its first. `variant` is the index or name of a material variant;
// if empty, primitives have their own materials. Scene::notes lists deviations from the file. Throws
// std::runtime_error: "FILE: OBJECT INDEX: what is wrong".
Scene loadGltf(const std::string& file, const std::string& scene, const std::string& variant,
               const LoadProgress& progress);

// Checks container, JSON, version, required extensions and variant, without loading data. Throws as
// loadGltf().
void checkGltf(const std::string& file, const std::string& variant);

// loadGltf() from memory; `name` replaces the file's name in messages. Buffers and images are embedded, or
// in `folder`.
Scene parseGltf(std::vector<unsigned char> bytes, const std::string& name,
                const std::filesystem::path& folder = {});

}  // namespace diptych
