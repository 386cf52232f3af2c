// SPDX-License-Identifier: MIT
// Animated files through the whole program: at one time, at several times in one report, and as numbered
// images.
#include "shared/image/exr.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

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

// A triangle around (-1, 0, 0), with keys at 0 s and 2 s for a channel of each type: a translation by 2 m
// along +X, and a weight from 0 to 1 of a morph target with the same displacement.
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

// 5 x 5 pixels, each a metre wide in the triangle's plane; the triangle covers one.
const std::string posedView =
    " --size 5x5 --camera 'eye=0,0,10 target=0,0,0 fov=28.072486935852957' --channels material_id";
const std::string reference = " --path reference --reference-mode scene";

// Coverage of the middle row's columns, such as "01000".
std::string columnsIn(const fs::path& exr) {
    const ImageFile image = readExr(exr);
    std::string row;
    for (const ImageLayer& layer : image.layers)
        if (layer.name == "material_id")
            for (int x = 0; x < 5; ++x) row += layer.image.at(x, 2) >= 0 ? '1' : '0';
    return row;
}

const std::vector<std::pair<double, std::string>> where{
    {0, "01000"}, {1, "00100"}, {2, "00010"}, {9, "00010"}};

// One report of both paths and the reference at four times, which differ in nothing but the time.
TEST(Motion, EveryPathDrawsItWhereItIsAtEachTimeOfOneReport) {
    const Folder folder;
    folder.write("node.gltf", byItsNode().dump());
    folder.write("target.gltf", byATarget().dump());
    for (const auto& [scene, more] :
         {std::pair<std::string, std::string>{"node", " --baseline reference --reference-mode scene"},
          {"target", " --baseline reference --reference-mode scene --skinning vertex"},
          {"target", " --baseline reference"}}) {
        const Ran ran =
            runTool(folder, "compare " + scene + ".gltf --times 0,1,2,9 --runs 0 -o r" + posedView + more);
        ASSERT_EQ(ran.code, 0) << ran.err << ran.out;
        const Json report = Json::parse(contentsOf(folder / "r/report.json"));
        ASSERT_EQ(report["frames"].size(), 12u);
        ASSERT_EQ(report["comparisons"].size(), 12u) << "three pairs at each time";
        for (std::size_t i = 0; i < 12; ++i) {
            const Json& frame = report["frames"][i];
            const auto& [time, columns] = where[i / 3];
            EXPECT_EQ(frame["settings"]["time"], time);
            const std::string exr = frame["exr"].get<std::string>();
            EXPECT_NE(exr.find(std::to_string(static_cast<int>(time)) + "s/"), std::string::npos) << exr;
            EXPECT_EQ(columnsIn(folder / ("r/" + exr)), columns) << exr << more;
        }
        for (const auto& [time, columns] : where)
            EXPECT_NE(contentsOf(folder / "r/junit.xml")
                          .find(", " + std::to_string(static_cast<int>(time)) + " s | "),
                      std::string::npos)
                << time;
    }
}

// A morph target at rest is applied too, and plan names the method.
TEST(Motion, ATargetAtRestIsPosedAndPlanSaysByWhat) {
    const Folder folder;
    Json target = byATarget();
    target.erase("animations");
    target["meshes"][0]["weights"] = {1};
    folder.write("target.gltf", target.dump());
    for (const std::string path :
         {" --path deferred", " --path forward_plus --skinning vertex", " --path reference"}) {
        const Ran ran = runTool(folder, "render target.gltf --runs 0" + posedView + path + " -o t.exr");
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(columnsIn(folder / "t.exr"), "00010") << path;
        EXPECT_EQ((ran.out + ran.err).find("undeformed"), std::string::npos) << ran.out << ran.err;
    }
    for (const auto& [skinning, words] : {std::pair{"compute", "deformed once per frame by compute shaders"},
                                          {"vertex", "deformed by the vertex shader of every draw"}}) {
        const Ran plan = runTool(folder, std::string("plan target.gltf --skinning ") + skinning);
        EXPECT_NE(plan.out.find(std::string("1 morphed mesh: 3 vertices, ") + words), std::string::npos)
            << plan.out;
    }
}

TEST(Motion, AnAnimationPlaysByItsName) {
    const Folder folder;
    Json file = byItsNode();
    file["animations"].push_back(byATarget()["animations"][0]);
    file["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 1}}};
    file["animations"][0]["name"] = "walk";
    file["animations"][1]["name"] = "bend";
    folder.write("a.gltf", file.dump());
    for (const auto& [options, columns] : {std::pair{" --time 1", "00010"},
                                           {" --time 1 --animation walk", "00100"},
                                           {" --time 2 --animation bend", "00010"},
                                           {" --time 2 --animation 0", "00010"}})
        for (const std::string& path : {reference, std::string(" --path deferred --runs 0")}) {
            const Ran ran = runTool(folder, "render a.gltf" + posedView + path + options + " -o a.exr");
            ASSERT_EQ(ran.code, 0) << ran.err;
            EXPECT_EQ(columnsIn(folder / "a.exr"), columns) << path << options;
        }
    EXPECT_TRUE(
        runTool(folder, "render a.gltf --animation run" + reference).failedOver("--animation \"run\""));
}

TEST(Motion, TimesThatCannotBeAreRefused) {
    const Folder folder;
    folder.write("node.gltf", byItsNode().dump());
    EXPECT_TRUE(runTool(folder, "render node.gltf --time -1" + reference)
                    .failedOver("--time -1: must be finite and at least 0"));
    EXPECT_TRUE(runTool(folder, "compare node.gltf --time 1 --times 0,1").failedOver("--times"));
    EXPECT_TRUE(runTool(folder, "compare node.gltf --times 0,soon").failedOver("--times 0,soon"));
    EXPECT_TRUE(runTool(folder, "compare node.gltf --times 0,1 --baseline b.exr")
                    .failedOver("--baseline b.exr: a file holds one view"));
    EXPECT_FALSE(fs::exists(folder / "diptych-report"));
}

// One line of output for each, and one file per path.
TEST(Motion, FramesAreNumberedImagesOfTheirTimes) {
    const Folder folder;
    folder.write("node.gltf", byItsNode().dump());
    folder.write("target.gltf", byATarget().dump());
    for (const auto& [scene, path] : {std::pair<std::string, std::string>{"node", reference},
                                      {"target", " --path reference"},
                                      {"target", " --path deferred --runs 0"},
                                      {"node", " --path forward_plus --runs 1"}}) {
        const Ran ran = runTool(folder, "render " + scene + ".gltf --frames 3 --fps 2 --time 1" + posedView +
                                            path + " -o out.exr");
        ASSERT_EQ(ran.code, 0) << ran.err;
        for (const auto& [number, time, columns] :
             {std::tuple{"0000", "1", "00100"}, {"0001", "1.5", ""}, {"0002", "2", "00010"}}) {
            const std::string name = std::string("out.") + number + ".exr";
            ASSERT_TRUE(fs::exists(folder / name)) << path;
            EXPECT_NE(ran.out.find(name + ": " + scene + ".gltf at " + time + " s, 5x5, "), std::string::npos)
                << ran.out;
            if (*columns != '\0') {
                EXPECT_EQ(columnsIn(folder / name), columns) << path << time;
            }
        }
        EXPECT_FALSE(fs::exists(folder / "out.0003.exr"));
        EXPECT_FALSE(fs::exists(folder / "out.exr"));
    }
}

TEST(Motion, FramesInAFolderAreListedAndReplaced) {
    const Folder folder;
    folder.write("node.gltf", byItsNode().dump());
    const std::string asked = "render node.gltf" + posedView + reference + " -o out";
    ASSERT_EQ(runTool(folder, asked + " --frames 3 --fps 1").code, 0);
    const Json listed = Json::parse(contentsOf(folder / "out/frames.json"));
    ASSERT_EQ(listed["frames"].size(), 3u);
    for (int i = 0; i < 3; ++i) {
        const std::string number = "000" + std::to_string(i);
        EXPECT_EQ(columnsIn(folder / ("out/reference." + number + ".exr")), where[i].second);
        EXPECT_TRUE(fs::exists(folder / ("out/material_id." + number + ".png")));
        EXPECT_EQ(listed["frames"][i]["settings"]["time"], i);
        EXPECT_EQ(listed["frames"][i]["file"], "out/reference." + number + ".exr");
    }
    // Fewer files replace more, one replaces several, and vice versa.
    ASSERT_EQ(runTool(folder, asked + " --frames 2").code, 0);
    EXPECT_FALSE(fs::exists(folder / "out/reference.0002.exr"));
    ASSERT_EQ(runTool(folder, asked + " --frames 1").code, 0);
    EXPECT_TRUE(fs::exists(folder / "out/frame.json"));
    EXPECT_FALSE(fs::exists(folder / "out/reference.0000.exr"));
    const Ran ran = runTool(folder, asked + " --frames 2 --json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_FALSE(fs::exists(folder / "out/frame.json"));
    EXPECT_EQ(Json::parse(ran.out)["frames"].size(), 2u);
}

// One exposure for all: otherwise lit would flicker as the sun rises.
TEST(Motion, ImagesOfAMotionAreExposedAlike) {
    const Folder folder;
    const Ran ran = runTool(folder,
                            "render builtin:motion --size 16x9 --frames 2 --fps 1 --runs 0 --channels lit "
                            "--shadows off -o m.png");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out.find("chosen from the first image, used for all"), std::string::npos) << ran.out;
    EXPECT_NE(contentsOf(folder / "m.0000.png"), contentsOf(folder / "m.0001.png"));
    const auto at = ran.out.find("exposure ") + 9;
    const std::string exposure = ran.out.substr(at, ran.out.find(',', at) - at);
    ASSERT_EQ(runTool(folder,
                      "render builtin:motion --size 16x9 --time 1 --runs 0 --channels lit "
                      "--shadows off -o one.png --exposure " +
                          exposure)
                  .code,
              0);
    const Ran same = runTool(folder, "diff m.0001.png one.png --metric max --tolerance 0.01");
    EXPECT_EQ(same.code, 0) << same.out << "the factor is printed with four digits";
}

// Checked before the first is rendered.
TEST(Motion, FramesReplaceNoFileOfOthers) {
    const Folder folder;
    folder.write("node.gltf", byItsNode().dump());
    folder.write("out.0002.exr", "a note");
    const std::string asked = "render node.gltf --frames 3 --fps 1" + posedView + reference;
    EXPECT_TRUE(runTool(folder, asked + " -o out.exr").failedOver("-o out.0002.exr"));
    EXPECT_FALSE(fs::exists(folder / "out.0000.exr"));
    ASSERT_EQ(runTool(folder, asked + " -o out.exr --force").code, 0);
    EXPECT_EQ(columnsIn(folder / "out.0002.exr"), "00010");
    ASSERT_EQ(runTool(folder, asked + " -o out.exr").code, 0) << "those of its own";
    folder.write("dir/mine.txt", "a note");
    EXPECT_TRUE(runTool(folder, asked + " -o dir").failedOver("-o dir"));
    EXPECT_TRUE(runTool(folder, "render node.gltf --frames 0").failedOver("--frames 0: must be 1 or more"));
    EXPECT_TRUE(
        runTool(folder, "render node.gltf --frames 2 --fps 0").failedOver("--fps 0: must be above 0"));
    EXPECT_TRUE(runTool(folder, asked + " builtin:triangle").failedOver("--frames 3: takes one scene"));
    EXPECT_TRUE(runTool(folder, asked + " --camera 0").failedOver("2 cameras are given"));
}

}  // namespace
}  // namespace diptych
