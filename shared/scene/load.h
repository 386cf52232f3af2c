// SPDX-License-Identifier: MIT
// From a name to a Scene: a glTF file or a built-in one.
#pragma once

#include "shared/scene/model/load_progress.h"
#include "shared/scene/model/scene.h"

#include <string>

namespace diptych {

// `where` is "builtin:NAME[?key=value&...]" or the file name of a .gltf or .glb. `progress` is called while
// loading goes on. Throws std::runtime_error: one line that names file, object and fault.
Scene loadScene(const std::string& where, const LoadProgress& progress = {});

// Reads what tells whether `where` is a scene at all, before its data: that the file is there, the lengths of
// its container, that its JSON is sound, version and required extensions. Throws as loadScene().
void checkScene(const std::string& where);

}  // namespace diptych
