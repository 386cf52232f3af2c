// SPDX-License-Identifier: MIT
// Animated files through the whole program: the reference at a given time, and the notes of the paths.
#include "shared/image/exr.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string_view>

namespace diptych {
namespace {

using Json = nlohmann::json;

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t j = 0; j < 3; ++j)
            group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += i + j <= bytes.size() ? digits[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

// A triangle around (-1, 0, 0), and keys at 0 s and 2 s for a channel of each kind: a translation by 2 m
// along +X, and a weight from 0 to 1 of the morph target that moves it likewise.
Json triangleFile() {
    std::string data;
    Json accessors = Json::array();
    const auto add = [&](std::initializer_list<float> values, const char* type, std::size_t width) {
        const std::size_t at = data.size();
        for (const float v : values) data.append(reinterpret_cast<const char*>(&v), sizeof v);
        accessors.push_back({{"bufferView", 0},
                             {"byteOffset", at},
                             {"componentType", 5126},
                             {"count", values.size() / width},
                             {"type", type}});
    };
    add({-1.5f, -0.5f, 0, -0.5f, -0.5f, 0, -1, 0.5f, 0}, "VEC3", 3);
    add({2, 0, 0, 2, 0, 0, 2, 0, 0}, "VEC3", 3);
    add({0, 2}, "SCALAR", 1);
    add({0, 0, 0, 2, 0, 0}, "VEC3", 3);
    add({0, 1}, "SCALAR", 1);
    Json file = {{"asset", {{"version", "2.0"}}},
                 {"scene", 0},
                 {"scenes", {{{"nodes", {0}}}}},
                 {"nodes", {{{"mesh", 0}}}},
                 {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}}};
    file["accessors"] = accessors;
    file["bufferViews"] = {{{"buffer", 0}, {"byteLength", data.size()}}};
    file["buffers"] = {
        {{"byteLength", data.size()}, {"uri", "data:application/octet-stream;base64," + base64(data)}}};
    return file;
}
Json animated(const char* path, int output) {
    Json file = triangleFile();
    file["animations"] = {{{"samplers", {{{"input", 2}, {"output", output}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
    return file;
}
Json byItsNode() {
    return animated("translation", 3);
}
Json byATarget() {
    Json file = animated("weights", 4);
    file["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 1}}};
    return file;
}

// The covered pixel of 5 x 5, each a metre wide in the triangle's plane.
const std::string posedView =
    " --size 5x5 --camera 'eye=0,0,10 target=0,0,0 fov=28.072486935852957' --channels material_id";
const std::string reference = " --path reference --reference-mode scene";

// Which columns of the middle row show the triangle, as "01000".
std::string columnsIn(const fs::path& exr) {
    const PictureFile picture = readExr(exr);
    std::string row;
    for (const PictureLayer& layer : picture.layers)
        if (layer.name == "material_id")
            for (int x = 0; x < 5; ++x) row += layer.image.at(x, 2) >= 0 ? '1' : '0';
    return row;
}

TEST(Motion, TheReferenceDrawsItWhereItIsAtATime) {
    const Folder folder;
    folder.write("node.gltf", byItsNode().dump());
    folder.write("target.gltf", byATarget().dump());
    for (const std::string scene : {"node", "target"})
        for (const auto& [time, columns] :
             {std::pair{"0", "01000"}, {"1", "00100"}, {"2", "00010"}, {"9", "00010"}}) {
            const std::string file = scene + time + ".exr";
            const Ran ran = runTool(folder, "render " + scene + ".gltf" + posedView + reference + " --time " +
                                                time + " -o " + file);
            ASSERT_EQ(ran.code, 0) << ran.err;
            EXPECT_EQ(columnsIn(folder / file), columns) << scene << " at " << time << " s";
        }
}

// At 0 s a path agrees with the reference if only nodes move; where it draws undeformed meshes, it says so.
TEST(Motion, ThePathsDrawTheStartAndSayWhatTheyLeave) {
    const Folder folder;
    Json node = byItsNode(), target = byATarget();
    // The first key has the value of the file's last one.
    node["animations"][0]["samplers"][0]["output"] = 3;
    node["accessors"][3]["byteOffset"] = node["accessors"][3]["byteOffset"].get<int>() + 12;
    node["accessors"][3]["count"] = 1;
    node["accessors"][2]["count"] = 1;
    target.erase("animations");
    target["meshes"][0]["weights"] = {1};
    folder.write("node.gltf", node.dump());
    folder.write("target.gltf", target.dump());
    for (const std::string path : {"deferred", "forward_plus"}) {
        ASSERT_EQ(
            runTool(folder, "render node.gltf --runs 0" + posedView + " --path " + path + " -o n.exr --force")
                .code,
            0);
        EXPECT_EQ(columnsIn(folder / "n.exr"), "00010") << path;
        const Ran ran = runTool(
            folder, "render target.gltf --runs 0" + posedView + " --path " + path + " -o t.exr --force");
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(columnsIn(folder / "t.exr"), "01000") << path;
        EXPECT_NE((ran.out + ran.err).find("1 morphed mesh: drawn undeformed by " + path + " yet"),
                  std::string::npos)
            << ran.out << ran.err;
    }
    const Ran ran = runTool(folder, "render target.gltf" + posedView + reference + " -o r.exr");
    EXPECT_EQ(columnsIn(folder / "r.exr"), "00010") << ran.err;
    EXPECT_EQ((ran.out + ran.err).find("undeformed"), std::string::npos) << ran.out << ran.err;
    const Ran plan = runTool(folder, "plan target.gltf");
    EXPECT_NE(plan.out.find("1 morphed mesh: no path poses them yet; the reference does"), std::string::npos)
        << plan.out;
}

TEST(Motion, ATimeThatNothingDrawsIsRefused) {
    const Folder folder;
    folder.write("node.gltf", byItsNode().dump());
    for (const std::string rest : {"", " --path deferred", " --path reference"})
        EXPECT_TRUE(
            runTool(folder, "render node.gltf --time 1" + rest).failedOver("--time 1 is not built yet"));
    EXPECT_TRUE(runTool(folder, "compare node.gltf --baseline reference --reference-mode scene --time 1")
                    .failedOver("--time 1 is not built yet"));
    EXPECT_TRUE(runTool(folder, "render node.gltf --time -1" + reference)
                    .failedOver("--time -1: is finite and at least 0"));
}

}  // namespace
}  // namespace diptych
