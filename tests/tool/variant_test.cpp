// SPDX-License-Identifier: MIT
// `--variant`: the material variants of a glTF file.
#include "shared/image/exr.h"
#include "tests/tool/fake_renderer.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace diptych {
namespace {

using Json = nlohmann::json;

// A triangle with material 0; with the variants blue and red it has the materials 1 and 2.
const char* const coloured = R"({
  "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0 ] } ], "nodes": [ { "mesh": 0 } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0,
    "extensions": { "KHR_materials_variants": { "mappings": [
      { "material": 1, "variants": [ 0 ] }, { "material": 2, "variants": [ 1 ] } ] } } } ] } ],
  "materials": [ {}, { "pbrMetallicRoughness": { "baseColorFactor": [ 0, 0, 1, 1 ] } },
                 { "pbrMetallicRoughness": { "baseColorFactor": [ 1, 0, 0, 1 ] } } ],
  "extensionsUsed": [ "KHR_materials_variants" ], "extensionsRequired": [ "KHR_materials_variants" ],
  "extensions": { "KHR_materials_variants": { "variants": [ { "name": "blue" }, { "name": "red" } ] } },
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
  "buffers": [ { "byteLength": 36,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" } ]
})";

const std::string small = " v.gltf --size 16x9 ";

// The index of the one material in the image.
int materialIn(const fs::path& exr) {
    for (const ImageLayer& layer : readExr(exr).layers)
        if (layer.name == "material_id") return static_cast<int>(*std::ranges::max_element(layer.image.data));
    return -1;
}

TEST(Variant, IsDrawnByEveryPath) {
    const Folder folder;
    folder.write("v.gltf", coloured);
    for (const auto& [option, material] :
         {std::pair{"", 0}, {"--variant 0", 1}, {"--variant red", 2}, {"--variant 1", 2}})
        for (const std::string path :
             {" --path deferred", " --path forward_plus", " --path reference --reference-mode scene"}) {
            const Ran ran = runTool(
                folder, "render" + small + option + path + " --runs 0 --channels material_id -o v.exr");
            ASSERT_EQ(ran.code, 0) << ran.err;
            EXPECT_EQ(materialIn(folder / "v.exr"), material) << option << path;
        }
}

TEST(Variant, IsListedByPlan) {
    const Folder folder;
    folder.write("v.gltf", coloured);
    const std::string own = runTool(folder, "plan" + small).out;
    EXPECT_NE(own.find("material variants; none is drawn"), std::string::npos) << own;
    const std::string red = runTool(folder, "plan --variant red" + small).out;
    EXPECT_NE(red.find("  material variants\n    0 blue                     --variant 0 draws it\n"
                       "    1 red                      drawn\n"),
              std::string::npos)
        << red;
    const Json json = Json::parse(runTool(folder, "plan --json --variant red" + small).out);
    const Json& variants = json["scenes"][0]["variants"];
    ASSERT_EQ(variants.size(), 2u);
    EXPECT_EQ(variants[0]["name"], "blue");
    EXPECT_EQ(variants[0]["drawn"], false);
    EXPECT_EQ(variants[1]["drawn"], true);
}

// The command in the report draws the same variant again, and a renderer of its own reads a copy of it.
TEST(Variant, IsSaidByReportsAndJobs) {
    const Folder folder;
    folder.write("v.gltf", coloured);
    writeRenderer(folder, "fake", {"keep", (folder / "kept").string()});
    for (const std::string option : {"", "--variant red"}) {
        runTool(folder,
                "compare" + small + option + any_image + "--runs 0 --channels lit -q --renderer f=fake.json");
        const Json report = Json::parse(contentsOf(folder / "diptych-report" / "report.json"));
        for (const Json& frame : report["frames"])
            EXPECT_EQ(frame["settings"]["variant"], option.empty() ? "" : "red");
        const auto command = report["comparisons"][0]["command"].get<std::vector<std::string>>();
        const auto said = std::ranges::find(command, "--variant");
        ASSERT_EQ(said == command.end(), option.empty());
        if (said != command.end()) {
            EXPECT_EQ(*(said + 1), "red");
        }
        const Json job = Json::parse(contentsOf(folder / "kept" / "job.json"));
        EXPECT_EQ(job["scene"]["copy"], !option.empty());
        EXPECT_EQ(job["settings"]["variant"], option.empty() ? "" : "red");
    }
}

TEST(Variant, ThatIsNotThereIsAnError) {
    const Folder folder;
    folder.write("v.gltf", coloured);
    for (const std::string command : {"compare", "render", "plan", "explain", "bench", "view"})
        for (const std::string choice : {"green", "2"})
            EXPECT_TRUE(runTool(folder, command + small + "--variant " + choice)
                            .failedOver("v.gltf: --variant \"" + choice +
                                        "\": the file's variants are 0 \"blue\", 1 \"red\""));
    EXPECT_TRUE(runTool(folder, "render builtin:triangle --variant red").failedOver("no material variants"));
    EXPECT_TRUE(runTool(folder, "compare" + small + "--deferred variant=red").failedOver("use --variant"));
}

}  // namespace
}  // namespace diptych
