// SPDX-License-Identifier: MIT
// A scene reduced to what a failure needs, and a glTF file of it.
#pragma once

#include "compare/audit/case.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace diptych::audit {

// The same case of one node for each primitive that is drawn, each with a mesh of its own, without textures
// and animations; nothing where something poses a vertex.
std::optional<Case> flattened(const Case& whole);

std::size_t triangleCount(const Scene& scene);

// A flattened case's scene as glTF 2.0: its buffer inside, its camera 0 the case's; lights are in a file of
// their own, as --lights reads it, because glTF knows no area lights.
std::string gltfOf(const Case& flat);
// The same as a .glb file, its buffer in the binary chunk.
std::string glbOf(const Case& flat);
// The materials of a flattened scene that such files hold, in their order there.
std::vector<int> writtenMaterials(const Scene& scene);
std::string lightsFileOf(const Case& flat);

}  // namespace diptych::audit
