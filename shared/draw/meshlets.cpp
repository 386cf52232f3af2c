// SPDX-License-Identifier: MIT
#include "shared/draw/meshlets.h"

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace diptych {

namespace {

struct Box {
    glm::vec3 min{std::numeric_limits<float>::infinity()}, max{-std::numeric_limits<float>::infinity()};
    void add(const glm::vec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    glm::length_t longest() const {
        const glm::vec3 side = max - min;
        return side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    }
};

using Triangles = std::span<std::uint32_t>;

// Calls leaf(triangles) for each part in order.
template <class Leaf>
void halve(std::span<const glm::vec3> centres, Triangles triangles, const Leaf& leaf) {
    if (triangles.size() <= maxMeshletTriangles) {
        std::ranges::sort(triangles);
        leaf(triangles);
        return;
    }
    Box box;
    for (const std::uint32_t triangle : triangles) box.add(centres[triangle]);
    const glm::length_t axis = box.longest();
    const std::size_t half = triangles.size() / 2;
    // Ties are broken by index, so the order does not depend on the standard library.
    std::ranges::nth_element(triangles, triangles.begin() + static_cast<std::ptrdiff_t>(half),
                             [&](std::uint32_t a, std::uint32_t b) {
                                 const float at = centres[a][axis], other = centres[b][axis];
                                 return at < other || (at == other && a < b);
                             });
    halve(centres, triangles.first(half), leaf);
    halve(centres, triangles.subspan(half), leaf);
}

}  // namespace

std::vector<Meshlet> buildMeshlets(std::span<const glm::vec3> positions, std::span<std::uint32_t> indices) {
    const std::vector<std::uint32_t> original(indices.begin(), indices.end());
    const std::size_t count = original.size() / 3;
    std::vector<glm::vec3> centres(count);
    for (std::size_t i = 0; i < count; ++i) {
        Box box;
        for (std::size_t corner = 0; corner < 3; ++corner) box.add(positions[original[3 * i + corner]]);
        centres[i] = box.min * 0.5f + box.max * 0.5f;
    }
    std::vector<std::uint32_t> triangles(count);
    std::iota(triangles.begin(), triangles.end(), 0u);
    std::vector<Meshlet> meshlets;
    std::uint32_t next = 0;
    halve(centres, triangles, [&](Triangles part) {
        Box box;
        const std::uint32_t first = next;
        for (const std::uint32_t triangle : part)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t index = original[3 * std::size_t{triangle} + corner];
                indices[next++] = index;
                box.add(positions[index]);
            }
        meshlets.push_back({first, next - first, box.min, box.max});
    });
    return meshlets;
}

}  // namespace diptych
