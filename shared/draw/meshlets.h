// SPDX-License-Identifier: MIT
// Meshlets: a few neighbouring triangles each, so that draws of a large mesh can skip culled parts. No
// Vulkan.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

struct Meshlet {
    std::uint32_t first_index = 0, index_count = 0;
    glm::vec3 min{0}, max{0};  // object space, of the triangles' corners
};

// Largest number of triangles in a meshlet. Larger primitives have meshlets of at least half as many.
inline constexpr std::size_t maxMeshletTriangles = 64;

// Recursively halves the triangles along the longest side of the box around their centres, down to
// maxMeshletTriangles per part. Reorders `indices`, three per triangle, all below positions.size(), so that
// meshlets are contiguous. Triangles keep their order within a meshlet, corners within a triangle.
std::vector<Meshlet> buildMeshlets(std::span<const glm::vec3> positions, std::span<std::uint32_t> indices);

}  // namespace diptych
