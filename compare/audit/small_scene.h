// SPDX-License-Identifier: MIT
// Reduces a scene to what a failure needs, rewrites its primitives, and writes it as a glTF file.
#pragma once

#include "compare/audit/case.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych::audit {

// The same case with one node and one mesh for each drawn primitive, without textures and animations.
// Empty if a vertex is skinned or morphed.
std::optional<Case> flattened(const Case& whole);

std::size_t triangleCount(const Scene& scene);

// Whether no joint and no morph target moves its vertices.
bool isRigid(const Primitive& primitive);
// An empty primitive of the same material.
Primitive withoutVertices(const Primitive& primitive);
// Calls visit(values of `to`, values of `from`) for each attribute of a rigid primitive that `from` has.
template <class Visit>
void eachAttribute(Primitive& to, const Primitive& from, const Visit& visit) {
    visit(to.positions, from.positions);
    visit(to.normals, from.normals);
    visit(to.tangents, from.tangents);
    for (std::size_t set = 0; set < 2; ++set)
        if (!from.texcoords[set].empty()) visit(to.texcoords[set], from.texcoords[set]);
    if (!from.colors.empty()) visit(to.colors, from.colors);
}
// Appends vertex `i` of a rigid primitive, and an index of its own.
void addVertex(Primitive& to, const Primitive& from, std::uint32_t i);

// Scene of a flattened case as glTF 2.0 with an embedded buffer; camera 0 is the case's. Lights are in a
// separate file for --lights, because glTF has no area lights.
std::string gltfOf(const Case& flat);
// The same as a .glb file, with its buffer in the binary chunk.
std::string glbOf(const Case& flat);
// Materials of a flattened scene that these files contain, in their order there.
std::vector<int> writtenMaterials(const Scene& scene);
std::string lightsFileOf(const Case& flat);

}  // namespace diptych::audit
