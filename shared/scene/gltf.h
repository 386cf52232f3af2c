// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/scene.h"

#include <string>

namespace diptych {

// A .gltf or .glb file, version 2.0, its default scene. Throws std::runtime_error:
// "FILE: OBJECT INDEX: what is wrong". What is read otherwise than the file says is in Scene::notes.
Scene loadGltf(const std::string& file);

}  // namespace diptych
