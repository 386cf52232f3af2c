// SPDX-License-Identifier: MIT
// builtin:covered: tiles of a wall, their layers and lights.
#include "shared/scene/builtin/builtin.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/view.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace diptych {
namespace {

std::string coveredFault(const std::string& name) {
    return faultOf([&] { makeBuiltin(name); });
}

// Centres of builtin:covered's tiles with these layers; of the front ones if `front`, else of those behind.
std::set<std::pair<double, double>> tilesWith(const Scene& scene, std::uint32_t layers, bool front = true) {
    std::set<std::pair<double, double>> tiles;
    for (const Node& node : scene.nodes) {
        const Primitive& tile = scene.meshes[static_cast<std::size_t>(node.mesh)].primitives[0];
        const glm::dvec4& at = node.parent_from_node[3];
        if (layersOf(scene.materials[static_cast<std::size_t>(tile.material)]) == layers &&
            (at.z == 0) == front)
            tiles.insert({at.x, at.y});
    }
    return tiles;
}

TEST(BuiltinCovered, AWallIsCoveredToTheTile) {
    const std::pair<const char*, std::uint32_t> kinds[] = {{"coated", gpu::LAYER_CLEARCOAT},
                                                           {"woven", gpu::LAYER_SHEEN},
                                                           {"brushed", gpu::LAYER_ANISOTROPY},
                                                           {"glass", gpu::LAYER_TRANSMISSION}};
    EXPECT_EQ(tilesWith(makeBuiltin("covered"), 0).size(), 400u);
    for (const auto& [kind, layer] : kinds) {
        std::set<std::pair<double, double>> fewer;
        for (const std::size_t percent : {1u, 5u, 25u, 100u}) {
            const Scene scene = makeBuiltin(std::string("covered?") + kind + "=" + std::to_string(percent));
            const auto tiles = tilesWith(scene, layer);
            EXPECT_EQ(tiles.size(), 4 * percent) << kind;
            EXPECT_EQ(tilesWith(scene, 0).size(), 400 - 4 * percent) << kind;
            EXPECT_EQ(tilesWith(scene, 0, false).size(), layer == gpu::LAYER_TRANSMISSION ? 4 * percent : 0)
                << kind;
            EXPECT_TRUE(std::ranges::includes(tiles, fewer)) << kind << ": the first tiles stay";
            fewer = tiles;
        }
    }
    const Scene all = makeBuiltin("covered?coated=5&woven=5&brushed=5&glass=5");
    for (const auto& [kind, layer] : kinds) EXPECT_EQ(tilesWith(all, layer).size(), 20u) << kind;
    EXPECT_EQ(tilesWith(all, 0).size(), 320u);
    // They are scattered: each quarter of the wall has a share of a quarter of them.
    int quarters[2][2] = {};
    for (const auto& [x, y] : tilesWith(makeBuiltin("covered?coated=25"), gpu::LAYER_CLEARCOAT))
        ++quarters[x > 0][y > 0];
    for (const auto& row : quarters)
        for (const int count : row) EXPECT_NEAR(count, 25, 12);  // three standard deviations
    EXPECT_NE(coveredFault("covered?coated=60&glass=41").find("are 101 % together"), std::string::npos);
    EXPECT_NE(coveredFault("covered?woven=101").find("it takes 0 to 100"), std::string::npos);
}

// Every tile and what stands behind glass covers a rectangle of 1/20 of the image's sides, and none
// overlaps another.
TEST(BuiltinCovered, ACoveredWallFillsTheImageOnce) {
    const Scene scene = makeBuiltin("covered?glass=25&coated=25");
    const Pose pose = poseAt(scene, 0);
    const View view = makeView(scene, pose, "", 1600, 900);
    std::set<std::tuple<bool, long, long>> cells;  // behind, column, row
    for (const Instance& instance : pose.instances) {
        glm::dvec2 low(1e9), high(-1e9);
        for (const glm::vec3& p : primitiveOf(scene, instance).positions) {
            const glm::dvec3 world(instance.world_from_object * glm::dvec4(p, 1));
            const glm::dvec4 at = view.clipFromWorld() * glm::dvec4(world - view.eye(), 1);
            const glm::dvec2 cell = 10.0 * (glm::dvec2(at) / at.w + 1.0);
            low = glm::min(low, cell);
            high = glm::max(high, cell);
        }
        // float32 positions of up to 0.4 m in 0.8
        EXPECT_NEAR(low.x, std::round(low.x), 1e-6);
        EXPECT_NEAR(low.y, std::round(low.y), 1e-6);
        EXPECT_NEAR(high.x - low.x, 1, 1e-6);
        EXPECT_NEAR(high.y - low.y, 1, 1e-6);
        EXPECT_TRUE(
            cells.insert({instance.world_from_object[3].z < 0, std::lround(low.x), std::lround(low.y)})
                .second);
    }
    EXPECT_EQ(cells.size(), 500u);
    for (const auto& [behind, column, row] : cells) {
        EXPECT_TRUE(column >= 0 && column < 20 && row >= 0 && row < 20) << column << " " << row;
        EXPECT_TRUE(cells.contains({false, column, row}));
    }
}

TEST(BuiltinCovered, ACoveredWallHasAsManyLightsAsItIsTold) {
    EXPECT_EQ(makeBuiltin("covered").lights.size(), 64u);
    EXPECT_TRUE(makeBuiltin("covered?lights=0").lights.empty());
    const Scene scene = makeBuiltin("covered?lights=1024");
    ASSERT_EQ(scene.lights.size(), 1024u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
    double in_range = 0;
    for (std::size_t i = 1; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        EXPECT_TRUE(std::abs(light.position.x) <= 8 && std::abs(light.position.y) <= 4.5);
        for (int x = 0; x < 16; ++x)
            for (int y = 0; y < 9; ++y)
                in_range += glm::distance(light.position, {x - 7.5, y - 4.0, 0}) < double{light.range};
    }
    EXPECT_NEAR(1 + in_range / (16 * 9), 35, 1);
}

}  // namespace
}  // namespace diptych
