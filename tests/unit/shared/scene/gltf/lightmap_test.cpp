// SPDX-License-Identifier: MIT
// Lightmaps in materials' extras.
#include "shared/image/exr.h"
#include "tests/support/gltf_material_builder.h"

#include "shared/scene/requirements.h"

#include <algorithm>

namespace diptych {
namespace {

using Json = nlohmann::json;

Json with(Json lightmap) {
    return {{"extras", {{"diptych", {{"lightmap", std::move(lightmap)}}}}}};
}

TEST(GltfLightmap, IsReadFromTheExtrasOnTheSecondSet) {
    const Scene scene = withMaterial(with({{"index", 0}, {"intensity", 2.5}})).load();
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.lightmap_texture.texture, 0);
    EXPECT_EQ(m.lightmap_texture.texcoord, 1) << "unless it is said otherwise";
    EXPECT_EQ(m.lightmap_intensity, 2.5f);
    EXPECT_EQ(scene.images.size(), 1u) << "its image is read";
    const Requirements needs = requirements(scene, poseAt(scene, 0));
    EXPECT_TRUE(needs.lightmap);
    EXPECT_EQ(needs.max_lightmap, 2.5f);
    const Material first = materialOf(with({{"index", 0}, {"texCoord", 0}}));
    EXPECT_EQ(first.lightmap_texture.texcoord, 0);
    EXPECT_EQ(first.lightmap_intensity, 1);
    EXPECT_EQ(materialOf(Json::object()).lightmap_texture.texture, -1);
}

TEST(GltfLightmap, WhatIsWrongLeavesItOutWithANote) {
    const std::pair<Json, const char*> cases[] = {
        {{{"index", 1}}, "index: 1 is not a whole number below 1"},
        {{{"index", 0.5}}, "index: 0.5 is not a whole number below 1"},
        {{{"index", -1}}, "index"},
        {{{"texCoord", 1}}, "index: is missing"},
        {{{"index", 0}, {"texCoord", 2}}, "texCoord: 2 is not a whole number below 2"},
        {{{"index", 0}, {"intensity", -1}}, "intensity"},
        {{{"index", 0}, {"strength", 1}}, "strength"},
        {3, "lightmap"},
    };
    for (const auto& [lightmap, why] : cases) {
        const Scene scene = withMaterial(with(lightmap)).load();
        EXPECT_EQ(scene.materials.at(0).lightmap_texture.texture, -1) << lightmap;
        ASSERT_EQ(scene.notes.size(), 1u) << lightmap;
        EXPECT_NE(scene.notes[0].find(why), std::string::npos) << scene.notes[0];
        EXPECT_TRUE(scene.notes[0].starts_with("material 0: extras: diptych")) << scene.notes[0];
        EXPECT_TRUE(scene.notes[0].ends_with(": left out")) << scene.notes[0];
    }
}

TEST(GltfLightmap, AnUnlitMaterialHasNone) {
    Json material = with({{"index", 0}});
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    EXPECT_EQ(materialOf(material).lightmap_texture.texture, -1);
}

TEST(GltfLightmap, TheLargestValueIsThatOfAnyColour) {
    for (const int brightest : {0, 1, 2}) {
        Image light(2, 1, 3, 0.25f);
        light.at(1, 0, brightest) = 8;
        GltfFile file = withMaterial(with({{"index", 0}, {"intensity", 0.5}}));
        const std::filesystem::path folder = std::filesystem::path(file.written()).parent_path();
        writeExr(folder / "light.exr", {{{"R", "G", "B"}, &light}});
        file.json["images"][0]["uri"] = "light.exr";
        const Scene scene = file.load();
        EXPECT_EQ(scene.images.at(0).largest, 8) << brightest;
        EXPECT_EQ(requirements(scene, poseAt(scene, 0)).max_lightmap, 4);
    }
}

// A float image beside the glTF: two pixels, one with a negative component.
TEST(GltfLightmap, OpenExrIsReadAsLinearLightAndOnlyThere) {
    Image light(2, 1, 3, 0.25f);
    light.at(0, 0, 1) = 40;
    light.at(1, 0, 2) = -1;
    GltfFile file = withMaterial(with({{"index", 0}}));
    const std::filesystem::path folder = std::filesystem::path(file.written()).parent_path();
    writeExr(folder / "light.exr", {{{"R", "G", "B"}, &light}});
    file.json["images"][0]["uri"] = "light.exr";
    const Scene scene = file.load();
    const TextureImage& image = scene.images.at(0);
    EXPECT_EQ(image.rgba32, (std::vector<float>{0.25f, 40, 0.25f, 1, 0.25f, 0.25f, 0, 1}));
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 1);
    EXPECT_EQ(image.largest, 40);
    EXPECT_TRUE(std::ranges::any_of(scene.notes, [](const std::string& note) {
        return note.find("negative; 0 is used") != std::string::npos;
    }));

    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    EXPECT_THROW(file.load(), std::runtime_error) << "glTF's own slots read PNG, JPEG and WebP";
}

}  // namespace
}  // namespace diptych
