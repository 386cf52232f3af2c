// SPDX-License-Identifier: MIT
// KHR_materials_variants: choices of materials by index or name.
#include "shared/scene/motion/pose.h"
#include "tests/support/gltf_builder.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

namespace diptych {
namespace {

using Json = nlohmann::json;
using Names = std::vector<std::string>;

constexpr const char* variantsName = "KHR_materials_variants";

Json mappingOf(int material, const std::vector<int>& variants) {
    return {{"material", material}, {"variants", variants}};
}

Json& variantsIn(GltfFile& f) {
    return f.json["extensions"][variantsName]["variants"];
}
Json& mappingsIn(GltfFile& f) {
    return f.primitive()["extensions"][variantsName]["mappings"];
}

// Two triangles in one mesh, and the materials m0 to m3. The first triangle has m0, with the variants beach
// and night m1, and with street m2. The second always has m3.
GltfFile withVariants() {
    GltfFile f = GltfFile::triangle();
    for (int i = 0; i < 4; ++i) f.json["materials"].push_back({{"name", fmt::format("m{}", i)}});
    Json second = f.primitive();
    second["material"] = 3;
    f.json["meshes"][0]["primitives"].push_back(second);
    f.primitive()["material"] = 0;
    for (const char* name : {"beach", "street", "night"}) variantsIn(f).push_back({{"name", name}});
    mappingsIn(f) = Json::array({mappingOf(1, {0, 2}), mappingOf(2, {1})});
    f.json["extensionsUsed"] = Json::array({variantsName});
    return f;
}

Scene variantOf(GltfFile& f, const std::string& variant) {
    return loadScene(f.written(), {}, variant);
}

std::string variantError(GltfFile& f, const std::string& variant) {
    return faultOf([&] { variantOf(f, variant); });
}

// Names of the primitives' materials, in order.
Names drawnMaterialsOf(const Scene& scene) {
    Names names;
    for (const Primitive& p : scene.meshes.at(0).primitives)
        names.push_back(scene.materials.at(static_cast<std::size_t>(p.material)).name);
    return names;
}

TEST(GltfVariants, GiveEachPrimitiveTheMaterialOfItsMapping) {
    GltfFile f = withVariants();
    for (const auto& [choice, material, index] :
         {std::tuple{"", "m0", -1}, {"0", "m1", 0}, {"1", "m2", 1}, {"2", "m1", 2}, {"street", "m2", 1}}) {
        const Scene scene = variantOf(f, choice);
        EXPECT_EQ(drawnMaterialsOf(scene), (Names{material, "m3"})) << choice;
        EXPECT_EQ(scene.variant, index) << choice;
        EXPECT_EQ(scene.variants, (Names{"beach", "street", "night"}));
        EXPECT_TRUE(scene.notes.empty()) << scene.notes[0];
    }
}

TEST(GltfVariants, LeaveAPrimitiveItsMaterialIfNothingMapsThem) {
    GltfFile f = withVariants();
    mappingsIn(f).erase(1);
    EXPECT_EQ(drawnMaterialsOf(variantOf(f, "street")), (Names{"m0", "m3"}));
    EXPECT_EQ(drawnMaterialsOf(variantOf(f, "beach")), (Names{"m1", "m3"}));
}

TEST(GltfVariants, GiveAMaterialToAPrimitiveWithoutOne) {
    GltfFile f = withVariants();
    f.primitive().erase("material");
    EXPECT_EQ(drawnMaterialsOf(variantOf(f, "")), (Names{"default", "m3"}));
    const Scene beach = variantOf(f, "beach");
    EXPECT_EQ(drawnMaterialsOf(beach), (Names{"m1", "m3"}));
    EXPECT_EQ(beach.materials.size(), 4u) << "no default material, which nothing needs";
}

// The file of an image that the drawn materials do not read may be missing.
TEST(GltfVariants, DecideWhichImagesAreRead) {
    GltfFile f = withVariants();
    f.json["images"] = {{{"uri", twoPixels}}, {{"uri", "missing.png"}}};
    f.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    const auto textureOf = [&](int material) -> Json& {
        return f.json["materials"][static_cast<std::size_t>(material)]["pbrMetallicRoughness"]
                     ["baseColorTexture"]["index"];
    };
    textureOf(0) = 0;
    textureOf(1) = 1;
    EXPECT_EQ(variantOf(f, "").images.size(), 1u);
    EXPECT_EQ(variantOf(f, "street").images.size(), 0u);
    EXPECT_NE(variantError(f, "beach").find("missing.png"), std::string::npos);
    std::swap(textureOf(0), textureOf(1));
    EXPECT_EQ(variantOf(f, "beach").images.size(), 1u);
    EXPECT_NE(variantError(f, "").find("missing.png"), std::string::npos);
}

TEST(GltfVariants, MayBreakOnlyWhatDrawsTheBrokenMaterial) {
    GltfFile f = withVariants();
    f.json["materials"][1]["alphaMode"] = "HALF";
    EXPECT_TRUE(mentions(variantOf(f, "").notes, "material 1: alphaMode is \"HALF\""));
    EXPECT_EQ(drawnMaterialsOf(variantOf(f, "street")), (Names{"m2", "m3"}));
    EXPECT_NE(variantError(f, "beach").find("material 1: alphaMode is \"HALF\""), std::string::npos);
}

TEST(GltfVariants, AreReadWhereTheyAreRequired) {
    GltfFile f = withVariants();
    f.json["extensionsRequired"] = Json::array({variantsName});
    EXPECT_EQ(drawnMaterialsOf(variantOf(f, "beach")), (Names{"m1", "m3"}));
    EXPECT_NO_THROW(checkScene(f.written()));
    f.json["materials"][2]["extensions"][variantsName] = Json::object();
    EXPECT_TRUE(
        mentions(f.load().notes, "material 2: KHR_materials_variants is not supported there: left out"));
}

// Pointers of animations name materials of the file.
TEST(GltfVariants, LeaveAnimatedMaterialsTheirIndices) {
    GltfFile f = withVariants();
    const int times = f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1);
    const int values = f.accessor<float>({0.25f, 0.75f}, FLOAT, "SCALAR", 1);
    Json target{{"path", "pointer"}};
    target["extensions"]["KHR_animation_pointer"]["pointer"] =
        "/materials/1/pbrMetallicRoughness/roughnessFactor";
    Json& animation = f.json["animations"][0];
    animation["samplers"] = Json::array({Json{{"input", times}, {"output", values}}});
    animation["channels"] = Json::array({Json{{"sampler", 0}, {"target", target}}});
    const Scene scene = variantOf(f, "beach");
    const Pose pose = poseAt(scene, 0.5);
    const auto drawn = static_cast<std::size_t>(scene.meshes.at(0).primitives.at(0).material);
    EXPECT_EQ(drawn, 1u);
    EXPECT_EQ(materialsOf(scene, pose).at(drawn).roughness, 0.5f);
    EXPECT_EQ(materialsOf(scene, pose).at(0).roughness, 1.0f);
}

// ---- faults ------------------------------------------------------------------------------------------

// The primitive then keeps its own material.
TEST(GltfVariants, LeaveOutAFaultyMappingWithANote) {
    const std::string who = "mesh 0, primitive 0: KHR_materials_variants: ";
    const std::pair<const char*, std::function<void(GltfFile&)>> cases[] = {
        {"has no array mappings", [](GltfFile& f) { mappingsIn(f) = 5; }},
        {"has no array mappings", [](GltfFile& f) { f.primitive()["extensions"][variantsName] = "red"; }},
        {"mapping 0: has no material", [](GltfFile& f) { mappingsIn(f)[0].erase("material"); }},
        {"mapping 0: has no material", [](GltfFile& f) { mappingsIn(f)[0] = "m1"; }},
        {"mapping 0: material: is not a whole number below 4",
         [](GltfFile& f) { mappingsIn(f)[0]["material"] = 4; }},
        {"mapping 0: material: is not a whole number below 4",
         [](GltfFile& f) { mappingsIn(f)[0]["material"] = -1; }},
        {"mapping 0: material: is not a whole number below 4",
         [](GltfFile& f) { mappingsIn(f)[0]["material"] = nullptr; }},
        {"mapping 0: has no array variants", [](GltfFile& f) { mappingsIn(f)[0]["variants"] = 0; }},
        {"mapping 0: variants[0]: is not a whole number below 3",
         [](GltfFile& f) { mappingsIn(f)[0]["variants"] = Json::array({3}); }},
        {"mapping 0: variants[0]: is not a whole number below 3",
         [](GltfFile& f) { mappingsIn(f)[0]["variants"] = Json::array({0.5}); }},
        {"mapping 0: variants[0]: is not a whole number below 3",
         [](GltfFile& f) { mappingsIn(f)[0]["variants"] = Json::array({"beach"}); }},
    };
    for (const auto& [fault, change] : cases) {
        GltfFile f = withVariants();
        change(f);
        for (const char* choice : {"beach", ""}) {
            const Scene scene = variantOf(f, choice);
            EXPECT_EQ(drawnMaterialsOf(scene), (Names{"m0", "m3"})) << fault;
            EXPECT_EQ(scene.notes, Names{who + fault + ": left out"});
        }
    }
}

TEST(GltfVariants, KeepWhatIsValidBesideAFault) {
    GltfFile f = withVariants();
    mappingsIn(f)[0]["variants"] = {9, 0};
    EXPECT_EQ(drawnMaterialsOf(variantOf(f, "beach")), (Names{"m1", "m3"}));
    EXPECT_EQ(drawnMaterialsOf(variantOf(f, "street")), (Names{"m2", "m3"}));
    EXPECT_EQ(variantOf(f, "beach").notes.size(), 1u);
}

TEST(GltfVariants, CountTheFirstOfTwoMappings) {
    GltfFile f = withVariants();
    mappingsIn(f)[1]["variants"] = {0, 1};
    const Scene scene = variantOf(f, "beach");
    EXPECT_EQ(drawnMaterialsOf(scene), (Names{"m1", "m3"}));
    EXPECT_EQ(scene.notes,
              Names{"mesh 0, primitive 0: KHR_materials_variants: mapping 1: variants[0]: variant "
                    "0 already has a material: left out"});
    EXPECT_EQ(drawnMaterialsOf(variantOf(f, "street")), (Names{"m2", "m3"}));
}

TEST(GltfVariants, OfAnUnreadableListAreLeftOut) {
    for (const Json& list : {Json(5), Json("beach"), Json(nullptr), Json::object()}) {
        GltfFile f = withVariants();
        variantsIn(f) = list;
        const Scene scene = variantOf(f, "");
        EXPECT_TRUE(scene.variants.empty());
        EXPECT_TRUE(mentions(scene.notes, "KHR_materials_variants: has no array variants: left out"));
        EXPECT_TRUE(mentions(scene.notes, "mapping 1: variants[0]: is not a whole number below 0: left out"));
    }
}

TEST(GltfVariants, WithoutANameHaveTheirIndex) {
    for (const Json& unnamed : {Json::object(), Json{{"name", 5}}, Json("street"), Json(nullptr)}) {
        GltfFile f = withVariants();
        variantsIn(f)[1] = unnamed;
        const Scene scene = variantOf(f, "1");
        EXPECT_EQ(drawnMaterialsOf(scene), (Names{"m2", "m3"}));
        EXPECT_EQ(scene.variants, (Names{"beach", "", "night"}));
        EXPECT_EQ(scene.notes,
                  Names{"KHR_materials_variants: variant 1: has no name; only its index selects it"});
    }
}

// ---- the choice --------------------------------------------------------------------------------------

TEST(GltfVariants, OfAnotherChoiceAreListed) {
    GltfFile f = withVariants();
    const std::string file = f.written();
    for (const char* choice : {"3", "-1", "Beach", "beach "})
        EXPECT_EQ(variantError(f, choice),
                  fmt::format("{}: --variant \"{}\": the file's variants are 0 \"beach\", 1 \"street\", 2 "
                              "\"night\"",
                              file, choice));
    for (int i = 3; i < 1000; ++i) variantsIn(f).push_back({{"name", "more"}});
    EXPECT_TRUE(variantError(f, "red").ends_with("19 \"more\" and 980 more"));
    EXPECT_LT(variantError(f, "red").size(), 600u);
    EXPECT_EQ(faultOf([&] { checkScene(file, "red"); }), variantError(f, "red")) << "without loading";
}

TEST(GltfVariants, AreMissedByNameInAFileWithoutThem) {
    GltfFile f = GltfFile::triangle();
    EXPECT_EQ(variantError(f, "0"), f.written() + ": --variant \"0\": the file has no material variants");
    EXPECT_EQ(faultOf([] { loadScene("builtin:triangle", {}, "red"); }),
              "builtin:triangle: --variant \"red\": built-in scenes have no material variants");
}

TEST(GltfVariants, OfOneNameAreChosenByIndex) {
    GltfFile f = withVariants();
    variantsIn(f)[2]["name"] = "beach";
    EXPECT_TRUE(variantError(f, "beach")
                    .ends_with("--variant \"beach\": is the name of 0 (beach), 2 (beach); give an index"));
    EXPECT_EQ(variantOf(f, "2").variant, 2);
}

TEST(GltfVariants, AreChosenByIndexBeforeTheirName) {
    GltfFile f = withVariants();
    variantsIn(f)[0]["name"] = "1";
    variantsIn(f)[2]["name"] = "7";
    EXPECT_EQ(variantOf(f, "1").variant, 1);
    EXPECT_EQ(variantError(f, "7"), f.written() +
                                        ": --variant \"7\": the file's variants are 0 \"1\", 1 "
                                        "\"street\", 2 \"7\"")
        << "there is no index 7";
}

// ---- real files --------------------------------------------------------------------------------------

TEST(GltfVariants, OfRealFilesReadTheirOwnImages) {
    const std::filesystem::path folder = DIPTYCH_SOURCE_DIR "/../shared/assets/layered";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "NO ASSETS at " << folder << ": real files are not tried";
    const std::string shoe = (folder / "MaterialsVariantsShoe/MaterialsVariantsShoe.gltf").string();
    for (const auto& [choice, material] : {std::pair{"", 0}, {"street", 2}}) {
        const Scene scene = loadScene(shoe, {}, choice);
        EXPECT_EQ(scene.variants, (Names{"midnight", "beach", "street"}));
        EXPECT_EQ(scene.meshes.at(0).primitives.at(0).material, material) << choice;
        EXPECT_EQ(scene.images.size(), 3u) << "its colours, the normals, and occlusion with roughness";
    }
    const std::string chair = (folder / "SheenChair/SheenChair.gltf").string();
    EXPECT_EQ(loadScene(chair, {}, "Mango Velvet").images.size(), 6u);
    const Scene peacock = loadScene(chair, {}, "Peacock Velvet");
    std::vector<int> materials;
    for (const Mesh& mesh : peacock.meshes)
        for (const Primitive& p : mesh.primitives) materials.push_back(p.material);
    EXPECT_EQ(materials, (std::vector<int>{4, 5, 2, 3})) << "fabric, wood, metal, label";
}

}  // namespace
}  // namespace diptych
