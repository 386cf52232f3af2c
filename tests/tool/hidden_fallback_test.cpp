// SPDX-License-Identifier: MIT
// Where a device lacks something, the program draws in another way, and the image is the same. hidden_support
// compares verdicts; these are images with one capability hidden against those of the whole device.
#include "tests/support/gltf_builder.h"
#include "tests/support/png_builder.h"
#include "tests/tool/hidden.h"

#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace diptych {
namespace {

// A skinned, morphed triangle over a floor, under a sun, with 16-bit textures of both kinds: colours and
// data.
std::string sceneForFallbacks() {
    using Json = nlohmann::json;
    GltfFile f = GltfFile::triangle();
    Json& attributes = f.primitive()["attributes"];
    attributes["NORMAL"] = f.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
    attributes["TEXCOORD_0"] = f.accessor<float>({0, 0, 1, 0, 0, 1}, FLOAT, "VEC2", 2);
    attributes["JOINTS_0"] = f.accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, UBYTE, "VEC4", 4);
    attributes["WEIGHTS_0"] =
        f.accessor<float>({0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0}, FLOAT, "VEC4", 4);
    f.primitive()["targets"] = {
        {{"POSITION", f.accessor<float>({0, 0, 0.25f, 0.125f, 0, 0, 0, 0.125f, 0.125f}, FLOAT, "VEC3", 3)},
         {"NORMAL", f.accessor<float>({0.125f, 0, 0, 0.125f, 0, 0, 0.125f, 0, 0}, FLOAT, "VEC3", 3)}}};
    f.primitive()["material"] = 0;
    f.json["meshes"][0]["weights"] = {0.5};
    const int corners = f.accessor<float>({-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2, 0}, FLOAT, "VEC3", 3),
              uv = f.accessor<float>({0, 0, 3, 0, 3, 3, 0, 3}, FLOAT, "VEC2", 2),
              order = f.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, USHORT, "SCALAR", 1);
    f.json["meshes"].push_back({{"primitives",
                                 {{{"attributes", {{"POSITION", corners}, {"TEXCOORD_0", uv}}},
                                   {"indices", order},
                                   {"material", 0}}}}});
    f.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}}}};
    f.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    f.json["images"] = {{{"uri", "color.png"}}, {{"uri", "data.png"}}};
    // Low bytes that 8 bits, and mostly half floats, lose.
    std::ofstream(testFolder() / "color.png", std::ios::binary)
        << pngOf({.bits = 16,
                  .width = 2,
                  .rows = {{3, 232, 11, 184, 78, 33, 82, 8, 11, 184, 78, 33},
                           {3, 232, 46, 225, 78, 33, 82, 8, 46, 225, 78, 33}}});
    std::ofstream(testFolder() / "data.png", std::ios::binary)
        << pngOf({.bits = 16,
                  .width = 2,
                  .rows = {{0, 0, 78, 35, 3, 233, 0, 0, 195, 84, 3, 233},
                           {0, 0, 78, 35, 82, 12, 0, 0, 195, 84, 82, 12}}});
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 3}}};
    f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    f.json["skins"] = {{{"joints", {1, 2}}}};
    f.json["nodes"] = {
        {{"mesh", 0}, {"skin", 0}, {"translation", {0, 0, 0.25}}},
        {{"translation", {0, 0, 0.25}}},
        {{"translation", {0, 0, 0.375}}, {"rotation", {0, 0, 0.1, 0.99}}},
        {{"mesh", 1}},
        {{"rotation", {0.2, 0.15, 0, 0.97}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        {{"camera", 0}, {"translation", {0.25, 0.25, 3}}}};
    f.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5};
    return "'" + f.written() + "'";
}

// The same arguments, or others that ask for what the fallback is.
struct Fallback {
    std::string hidden, arguments;
    double tolerance;        // of lit, up to 1; 0: the same bits
    std::string note = {};   // that says so
    std::string whole = {};  // arguments of the whole device; empty: the same
};

const std::vector<Fallback>& fallbacks() {
    static const std::string all_lights =
        "SCENE --path deferred --msaa 4 --shadows off --lights point:500,spot:500,area:60";
    static const std::string forward = "SCENE --path forward_plus --shadows ";
    static const std::string halves = "moments in 16-bit floats: the device does not filter 32-bit floats";
    // A float32 holds every code of 16 bits: less than half a code of the largest is lost.
    constexpr double code = 0.5 / 65535;
    // Half floats round to 11 bits.
    constexpr double half = 1.0 / 4096;
    // Biases of the moments, 6e-5 and 3e-5, change light by as much; those of half floats are 64 times as
    // large.
    constexpr double biases = 2e-4;
    static const std::vector<Fallback> list{
        // Sample groups by draws instead of a list.
        {"feature shaderStorageImageMultisample", all_lights, 0},
        {"feature fragmentStoresAndAtomics", all_lights, 0},
        // Lights of every kind by address.
        {"limit maxTexelBufferElements 2048", all_lights, 0},
        // Poses without 64-bit pairs.
        {"feature shaderInt64", all_lights, 0},
        {"feature occlusionQueryPrecise", forward + "off", 0},
        {"feature pipelineStatisticsQuery", forward + "off", 0},
        {"extension VK_EXT_memory_budget", forward + "off", 0},
        {"format R16G16B16A16_UNORM filtered", forward + "off", code},
        {"format R32G32B32A32_SFLOAT filtered", forward + "off", half,
         "1 texture with over 8 bits per component: sampled as half floats (11 bits), the widest format"},
        {"format R32G32_SFLOAT filtered", forward + "evsm", 0, halves,
         forward + "evsm --evsm-precision fp16"},
        {"format R32G32B32A32_SFLOAT stored_unnamed", forward + "evsm4", 0, halves,
         forward + "evsm4 --evsm-precision fp16"},
        {"format R16G16B16A16_UNORM stored", forward + "msm4", biases,
         "moments in 32-bit floats: the device cannot store and filter 16-bit UNORM"},
        // Fragment lists of a few rows of pixels at a time.
        {"limit maxStorageBufferRange 9000",
         "builtin:crossed --path forward_plus --transparency list --shadows off", 0},
    };
    return list;
}

TEST(HiddenFallbacks, DrawTheSameImage) {
    const Folder folder;
    const std::string scene = sceneForFallbacks();
    const auto render = [&](const std::string& hidden, std::string arguments, const std::string& name) {
        if (const std::size_t at = arguments.find("SCENE"); at != arguments.npos)
            arguments.replace(at, 5, scene);
        return runHiding(folder, hidden,
                         "render " + arguments + " --size 24x14 --channels lit --runs 0 -o " + name);
    };
    std::string drawn;
    for (const Fallback& f : fallbacks()) {
        SCOPED_TRACE(f.hidden + ": " + f.arguments);
        const std::string whole = f.whole.empty() ? f.arguments : f.whole;
        if (whole != drawn) {
            const Ran ran = render("", whole, "whole.exr");
            ASSERT_EQ(ran.code, 0) << ran.err;
            if (f.whole.empty() && !f.note.empty()) {
                EXPECT_EQ(ran.out.find(f.note), std::string::npos) << ran.out;
            }
            drawn = whole;
        }
        const Ran ran = render(f.hidden, f.arguments, "hidden.exr");
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_NE(ran.out.find(f.note), std::string::npos) << ran.out;
        if (f.tolerance == 0 && f.whole.empty()) {
            EXPECT_TRUE(contentsOf(folder / "whole.exr") == contentsOf(folder / "hidden.exr"));
            continue;
        }
        const Ran diff = runTool(
            folder, fmt::format("diff --metric max --tolerance {} whole.exr hidden.exr", f.tolerance));
        EXPECT_EQ(diff.code, 0) << diff.out << diff.err;
    }
}

// A new optional feature needs a row above. The features listed here have none: the program refuses to draw
// without them, or lavapipe never uses them (GpuChoice draws with them).
TEST(HiddenFallbacks, AreTestedForEveryOptionalFeature) {
    std::set<std::string> known{
        "independentBlend", "shaderBufferInt64Atomics", "geometryShader",
        "shaderFloat16",    "multiDrawIndirect",        "drawIndirectFirstInstance",
    };
    for (const Fallback& f : fallbacks())
        if (f.hidden.starts_with("feature ")) known.insert(f.hidden.substr(8));
#define DIPTYCH_FALLBACK(version, name, need, what) \
    EXPECT_TRUE(std::string(#need) != "optional" || known.contains(#name)) << #name;
    DEVICE_FEATURES(DIPTYCH_FALLBACK)
#undef DIPTYCH_FALLBACK
}

}  // namespace
}  // namespace diptych
