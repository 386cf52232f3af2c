// SPDX-License-Identifier: MIT
#include "shared/scene/default_view.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/requirements.h"
#include "tests/support/gltf_builder.h"

using namespace diptych;
using Json = nlohmann::json;

namespace {
const std::filesystem::path assets = std::filesystem::path(DIPTYCH_SOURCE_DIR "/../shared") / "assets";
}

// Triangles, draws and extents from the assets' own table; the default view of Sponza is from inside.
TEST(GltfAssets, ScenesHaveTheirTabledSizes) {
    if (!std::filesystem::exists(assets))
        GTEST_SKIP() << "NO ASSETS at " << assets << ": real files are not tried";
    struct Row {
        const char* file;
        std::uint64_t triangles, draws;
        double x, y, z;
    };
    for (const Row& row : {Row{"sponza/Sponza.gltf", 262267, 103, 29.77, 12.45, 18.31},
                           Row{"flight_helmet/FlightHelmet.gltf", 94722, 6, 0.37, 0.72, 0.37},
                           Row{"pbr_spheres/PBR_Spheres.glb", 100320, 12, 0.81, 0.89, 0.06},
                           Row{"features/box/Box.glb", 12, 1, 1, 1, 1},
                           Row{"features/lights_punctual/Lights.glb", 12, 1, 2, 2, 2},
                           Row{"features/emission_strength/14_emission_strength.gltf", 17280, 18, 36, 2, 2},
                           Row{"features/vertex_color_test/VertexColorTest.gltf", 36, 2, 2, 2, 0.07},
                           Row{"features/node_hierarchy/02_node_hierarchy.gltf", 60, 2, 6, 6, 2},
                           Row{"features/sparse_accessor/SimpleSparseAccessor.gltf", 12, 1, 6, 4, 0},
                           Row{"low_poly_terrain/terrain.glb", 3868, 68, 16.68, 10.14, 16.74},
                           Row{"dutch_ship/dutch_ship_medium_1k.gltf", 69162, 3, 24.07, 24.66, 6.81},
                           Row{"normal_tangent_test/NormalTangentTest.glb", 7774, 1, 2.22, 2.15, 0.09}}) {
        const Scene scene = loadScene((assets / "scenes" / row.file).string(), [](double, const char*) {});
        const Pose pose = poseAt(scene, 0);
        const Requirements r = requirements(scene, pose);
        EXPECT_EQ(r.triangles, row.triangles) << row.file;
        EXPECT_EQ(r.draws, row.draws) << row.file;
        const Bounds bounds = worldBounds(scene, pose);
        const glm::dvec3 extent = bounds.max - bounds.min;
        const double expected[] = {row.x, row.y, row.z};
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(extent[c], expected[c], 0.0101) << row.file << ": the table has two decimals";
        for (const Mesh& mesh : scene.meshes)
            for (const Primitive& p : mesh.primitives) {
                ASSERT_EQ(p.normals.size(), p.positions.size());
                ASSERT_EQ(p.tangents.size(), p.positions.size());
            }
        if (std::string_view(row.file).starts_with("sponza")) {
            const DefaultView view = chooseDefaultView(scene);
            EXPECT_EQ(view.viewpoint, DefaultView::Viewpoint::inside);
            EXPECT_GT(view.covered, 0.95);
        }
    }
}

TEST(GltfAssets, RequiredWebpTexturesAreRead) {
    const std::filesystem::path file = assets / "layered/WebpBoxTextured/box-textured-separate.gltf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "NO ASSETS at " << file << ": real files are not tried";
    const Scene scene = loadScene(file.string());
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].name, "cesium logo.webp");
    EXPECT_EQ(scene.images[0].width, 128);
    EXPECT_EQ(scene.images[0].height, 128);
    EXPECT_EQ(scene.images[0].rgba.size(), 4u * 128 * 128);
    EXPECT_EQ(scene.materials.at(0).base_color_texture.texture, 0);
}

// One bottle in both models, and two labels.
TEST(GltfAssets, RequiredSpecularGlossinessIsRead) {
    const std::filesystem::path file = assets / "layered/SpecGlossVsMetalRough/SpecGlossVsMetalRough.gltf";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "NO ASSETS at " << file << ": real files are not tried";
    const Scene scene = loadScene(file.string());
    ASSERT_EQ(scene.materials.size(), 4u);
    const auto nameOf = [&](const TextureSlot& slot) {
        const Texture& texture = scene.textures.at(static_cast<std::size_t>(slot.texture));
        return scene.images.at(static_cast<std::size_t>(texture.image)).name;
    };
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(scene.materials[i].specular_glossiness, i == 0 || i == 3);
    EXPECT_EQ(nameOf(scene.materials[0].base_color_texture), "WaterBottle_diffuse.png");
    EXPECT_EQ(nameOf(scene.materials[0].specular_color_texture), "WaterBottle_specularGlossiness.png");
    EXPECT_EQ(scene.materials[0].roughness, 0);
    EXPECT_EQ(scene.materials[3].roughness, 1);
    EXPECT_EQ(scene.materials[3].specular_color, glm::vec3(0));
    EXPECT_EQ(scene.notes, std::vector<std::string>{});
}

TEST(GltfAssets, MalformedFilesEndInASceneOrOneLine) {
    if (!std::filesystem::exists(assets))
        GTEST_SKIP() << "NO ASSETS at " << assets << ": malformed files are not tried";
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets / "malformed")) {
        if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
        ++files;
        try {
            const Scene scene = loadScene(entry.path().string());
            worldBounds(scene, poseAt(scene, 0));
        } catch (const std::runtime_error& e) {
            EXPECT_TRUE(std::string(e.what()).starts_with(entry.path().string() + ": ")) << e.what();
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        }
    }
    EXPECT_GT(files, 50);
}
