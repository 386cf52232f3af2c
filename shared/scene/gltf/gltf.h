// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/load_progress.h"
#include "shared/scene/model/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// Loads a .gltf or .glb file, version 2.0. `scene` is the index or name of one of its scenes; empty: its
// default scene, which is the first where it names none. Scene::notes lists what was read otherwise than as
// the file says. Throws std::runtime_error: "FILE: OBJECT INDEX: what is wrong".
Scene loadGltf(const std::string& file, const std::string& scene = "", const LoadProgress& progress = {});

// Checks what is read before any data: container, JSON, version, required extensions. Throws as loadGltf().
void checkGltf(const std::string& file);

// loadGltf() from memory; `name` is the file's name in messages. Buffers and images are embedded, or in
// `folder` if it is given.
Scene parseGltf(std::vector<unsigned char> bytes, const std::string& name,
                const std::filesystem::path& folder = {});

}  // namespace diptych
