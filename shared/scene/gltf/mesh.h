// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace diptych::gltf {

struct Model;

// Reads the meshes that the scene's nodes draw, on all cores: triangles with normals and tangents, joints
// if skinned, morph targets. Indices are the file's; a mesh that is not drawn has no primitives.
// Primitives of points and lines are omitted with a note. The scene must already have nodes, skins and
// materials. `broken`: meshes that cannot be read, with the reason. They and faulty primitives are
// omitted, the latter with a note; it is an error if nothing else is drawn. Throws std::runtime_error; if
// decoding would exceed limits.h, before it starts. `tally` is called for each primitive, from any thread.
std::vector<Mesh> readMeshes(const Model& model, const Scene& scene,
                             const std::map<std::size_t, std::string>& broken,
                             std::vector<std::string>& notes, const std::function<void()>& tally);

}  // namespace diptych::gltf
