// SPDX-License-Identifier: MIT
// Meshlets: together they are the primitive they were cut from.
#include "shared/draw/meshlets.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <random>

namespace diptych {
namespace {

struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

// Small triangles, spread over a flat box.
Triangles soup(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> part(0, 1);
    Triangles soup;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at(16 * part(random), part(random), 4 * part(random));
        for (int corner = 0; corner < 3; ++corner) {
            soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
            soup.positions.push_back(at + 0.01f * glm::vec3(part(random), part(random), part(random)));
        }
    }
    // Shuffled, so that indices do not follow the order of triangles.
    std::ranges::shuffle(soup.positions, random);
    return soup;
}

std::vector<std::array<std::uint32_t, 3>> sorted(const std::vector<std::uint32_t>& indices) {
    std::vector<std::array<std::uint32_t, 3>> all;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        all.push_back({indices[i], indices[i + 1], indices[i + 2]});
    std::ranges::sort(all);
    return all;
}

TEST(Meshlets, HoldEveryTriangleOnceWithItsCornersInOrder) {
    for (const std::size_t count : {1, 64, 65, 1000}) {
        const Triangles original = soup(count);
        std::vector<std::uint32_t> indices = original.indices;
        const std::vector<Meshlet> meshlets = buildMeshlets(original.positions, indices);
        EXPECT_EQ(sorted(indices), sorted(original.indices));
        std::uint32_t next = 0;
        for (const Meshlet& meshlet : meshlets) {
            EXPECT_EQ(meshlet.first_index, next);
            next += meshlet.index_count;
            EXPECT_LE(meshlet.index_count, 3 * maxMeshletTriangles);
            EXPECT_GE(meshlet.index_count, 3 * std::min(count, maxMeshletTriangles / 2));
            glm::vec3 min = original.positions[indices[meshlet.first_index]], max = min;
            for (std::uint32_t i = 0; i < meshlet.index_count; ++i) {
                if (i % 3 == 0 && i > 0) {
                    EXPECT_LT(indices[meshlet.first_index + i - 3], indices[meshlet.first_index + i]);
                }
                min = glm::min(min, original.positions[indices[meshlet.first_index + i]]);
                max = glm::max(max, original.positions[indices[meshlet.first_index + i]]);
            }
            EXPECT_EQ(meshlet.min, min);
            EXPECT_EQ(meshlet.max, max);
        }
        EXPECT_EQ(next, original.indices.size());
    }
}

// Neighbours are together: the volume of all meshlets' boxes is a small fraction of the whole.
TEST(Meshlets, AreSmall) {
    Triangles original = soup(4096);
    std::ranges::sort(original.indices);
    for (std::size_t i = 0; i < original.positions.size(); i += 3) {
        const glm::vec3 at = original.positions[i];
        original.positions[i + 1] = at + glm::vec3(0.01f, 0, 0);
        original.positions[i + 2] = at + glm::vec3(0, 0, 0.01f);
    }
    double sum = 0;
    for (const Meshlet& meshlet : buildMeshlets(original.positions, original.indices)) {
        const glm::vec3 side = meshlet.max - meshlet.min;
        sum += double{side.x} * double{side.z};
    }
    EXPECT_LT(sum, 1.5 * 16 * 4);
}

}  // namespace
}  // namespace diptych
