// SPDX-License-Identifier: MIT
// Copies of a scene with one change: lights, hidden copies of triangles, empty triangles, materials,
// blending.
#include "compare/choose/variations.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace diptych::choose {
namespace {

// A triangle with all attributes, in the plane z = 0, of extent (3, 4, 0).
Primitive flatTriangle(int material) {
    Primitive made;
    made.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    made.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    made.tangents = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, -1}};
    made.texcoords[0] = {{0, 0}, {1, 0}, {0, 1}};
    made.texcoords[1] = {{0, 0}, {2, 0}, {0, 2}};
    made.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
    made.indices = {0, 1, 2};
    made.material = material;
    return made;
}

// Materials 0 and 1 are opaque, 2 is blended, 3 transmits. The primitives use 1, 0, 1, 2, 3, 2.
Scene layered() {
    Scene scene;
    scene.materials.resize(4);
    for (std::size_t i = 0; i < 4; ++i) scene.materials[i].name = std::string(1, static_cast<char>('a' + i));
    scene.materials[2].alpha_mode = AlphaMode::blend;
    scene.materials[3].transmission = 0.5;
    scene.meshes.resize(2);
    for (const int material : {1, 0, 1}) scene.meshes[0].primitives.push_back(flatTriangle(material));
    for (const int material : {2, 3, 2}) scene.meshes[1].primitives.push_back(flatTriangle(material));
    return scene;
}
std::vector<int> materialsIn(const Scene& scene) {
    std::vector<int> all;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives) all.push_back(primitive.material);
    return all;
}

// n lights in place of each, with one shadow; or every n-th.
TEST(VariedScenes, LightsAreRepeatedOrLeftOut) {
    Scene scene = layered();
    scene.lights.resize(7);
    std::vector<Light> lights(5);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].name = std::to_string(i);
        lights[i].shadow = true;
        lights[i].node = lights[i].source = 3;
    }
    const auto names = [&](double factor) {
        std::string all;
        for (const Light& light : withLights(scene, lights, factor).lights) {
            all += light.name + (light.shadow ? "s " : " ");
            EXPECT_EQ(light.node, -1);
            EXPECT_EQ(light.source, -1);
        }
        return all;
    };
    EXPECT_EQ(names(1), "0s 1s 2s 3s 4s ");
    EXPECT_EQ(names(3), "0s 0 0 1s 1 1 2s 2 2 3s 3 3 4s 4 4 ");
    EXPECT_EQ(names(1.0 / 2), "0s 2s 4s ");
    EXPECT_EQ(names(1.0 / 3), "0s 3s ");
    EXPECT_EQ(withLights(scene, lights, 1).meshes.size(), 2u);
}

// The deepest copy comes first; each is a thousandth of the extent deeper than the next.
TEST(VariedScenes, HiddenCopiesStandBelowOpaqueTriangles) {
    Scene scene = layered();
    scene.meshes[0].primitives[1].joint_sets.resize(1);
    scene.meshes[0].primitives[2].targets.resize(1);
    const Scene varied = withOverdraw(scene, 2);
    const Primitive &own = scene.meshes[0].primitives[0], &made = varied.meshes[0].primitives[0];
    EXPECT_EQ(made.indices, (std::vector<std::uint32_t>{3, 4, 5, 6, 7, 8, 0, 1, 2}));
    ASSERT_EQ(made.positions.size(), 9u);
    for (const std::size_t size : {made.normals.size(), made.tangents.size(), made.texcoords[0].size(),
                                   made.texcoords[1].size(), made.colors.size()})
        EXPECT_EQ(size, 9u);
    constexpr float step = 5e-3f;  // of |(3, 4, 0)| = 5
    for (std::size_t i = 0; i < 9; ++i) {
        const std::size_t of = i % 3;
        const float depth = i < 3 ? 0 : i < 6 ? 2 * step : step;
        EXPECT_FLOAT_EQ(made.positions[i].x, own.positions[of].x);
        EXPECT_FLOAT_EQ(made.positions[i].y, own.positions[of].y);
        EXPECT_FLOAT_EQ(made.positions[i].z, -depth);
        EXPECT_EQ(made.tangents[i].w, own.tangents[of].w);
        EXPECT_EQ(made.texcoords[1][i].x, own.texcoords[1][of].x);
        EXPECT_EQ(made.texcoords[0][i].y, own.texcoords[0][of].y);
        EXPECT_EQ(made.colors[i].x, own.colors[of].x);
    }
    for (std::size_t mesh = 0; mesh < 2; ++mesh)
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(varied.meshes[mesh].primitives[i].indices.size(), mesh == 0 && i == 0 ? 9u : 3u)
                << "skinned, morphed and blended ones stay";
}

TEST(VariedScenes, EmptyTrianglesHaveOneEdge) {
    Scene scene = layered();
    scene.meshes[0].primitives[0].indices = {0, 1, 2, 2, 1, 0};
    EXPECT_EQ(withEmptyTriangles(scene, 2).meshes[0].primitives[0].indices,
              (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0, 0, 1, 1, 2, 1, 1, 0, 1, 1, 2, 1, 1}));
    EXPECT_EQ(withEmptyTriangles(scene, 0).meshes[0].primitives[0].indices.size(), 6u);
}

TEST(VariedScenes, MaterialsAreSharedOrOwn) {
    const Scene scene = layered();
    EXPECT_EQ(materialsIn(withOneMaterial(scene)), (std::vector<int>{1, 1, 1, 2, 3, 2}));
    const Scene own = withOwnMaterials(scene);
    EXPECT_EQ(materialsIn(own), (std::vector<int>{1, 0, 4, 2, 3, 5}));
    ASSERT_EQ(own.materials.size(), 6u);
    EXPECT_EQ(own.materials[4].name, "b");
    EXPECT_EQ(own.materials[5].name, "c");
}

TEST(VariedScenes, AllMaterialsBlendOrNone) {
    Scene scene = layered();
    scene.materials[1].alpha_mode = AlphaMode::mask;
    const Scene all = withBlends(scene, true), none = withBlends(scene, false);
    const AlphaMode some[] = {AlphaMode::blend, AlphaMode::blend, AlphaMode::blend, AlphaMode::opaque},
                    others[] = {AlphaMode::opaque, AlphaMode::mask, AlphaMode::opaque, AlphaMode::opaque};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(all.materials[i].alpha_mode, some[i]) << i;
        EXPECT_EQ(none.materials[i].alpha_mode, others[i]) << i;
        EXPECT_EQ(all.materials[i].transmission, scene.materials[i].transmission)
            << "transmission blends already";
        EXPECT_EQ(none.materials[i].transmission, 0) << i;
    }
}

}  // namespace
}  // namespace diptych::choose
