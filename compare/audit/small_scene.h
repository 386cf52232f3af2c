// SPDX-License-Identifier: MIT
// Reduces a scene to what a failure needs, and writes it as a glTF file.
#pragma once

#include "compare/audit/case.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace diptych::audit {

// The same case with one node and one mesh for each drawn primitive, without textures and animations.
// Empty if a vertex is skinned or morphed.
std::optional<Case> flattened(const Case& whole);

std::size_t triangleCount(const Scene& scene);

// Scene of a flattened case as glTF 2.0 with an embedded buffer; camera 0 is the case's. Lights are in a
// separate file for --lights, because glTF has no area lights.
std::string gltfOf(const Case& flat);
// The same as a .glb file, with its buffer in the binary chunk.
std::string glbOf(const Case& flat);
// Materials of a flattened scene that these files contain, in their order there.
std::vector<int> writtenMaterials(const Scene& scene);
std::string lightsFileOf(const Case& flat);

}  // namespace diptych::audit
