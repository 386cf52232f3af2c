// SPDX-License-Identifier: MIT
// Parts of primitives: a few neighbouring triangles each, so that of a large mesh a draw can leave out what
// it need not draw. No Vulkan.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

struct Cluster {
    std::uint32_t first_index = 0, index_count = 0;
    glm::vec3 min{0}, max{0};  // object, of its triangles' corners
};

// Of a cluster; half as many at least where a primitive has more than that.
inline constexpr std::size_t clusterTriangles = 64;

// Halves the triangles along the longest side of the box around their centres until few enough are left in
// each part. `indices`, three a triangle, all below positions.size(), are put into the order of the clusters,
// which lie one after the other; in a cluster triangles keep their order, and each its corners'.
std::vector<Cluster> cutIntoClusters(std::span<const glm::vec3> positions, std::span<std::uint32_t> indices);

}  // namespace diptych
