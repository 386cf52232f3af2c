// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/load_progress.h"
#include "shared/scene/model/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// A .gltf or .glb file, version 2.0. `scene` is one of its scenes by index or name; empty: its default, which
// is its first where it names none. What is read otherwise than the file says is in Scene::notes. Throws
// std::runtime_error: "FILE: OBJECT INDEX: what is wrong".
Scene loadGltf(const std::string& file, const std::string& scene = "", const LoadProgress& progress = {});

// The same from memory, called `name`; its buffers and images are inside it, or in `folder` where there is
// one.
Scene parseGltf(std::vector<unsigned char> bytes, const std::string& name,
                const std::filesystem::path& folder = {});

}  // namespace diptych
