// SPDX-License-Identifier: MIT
// EXT_lights_image_based: a scene's environment as the images of a cube.
#include "compare/reference/light/environment.h"
#include "shared/image/png.h"
#include "shared/scene/image/cube_map.h"
#include "tests/support/gltf_builder.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <functional>

namespace diptych {
namespace {

using Json = nlohmann::json;

const std::array<glm::dvec3, 6> cubeAxes{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
constexpr int cubeSide = 16;

// Each face has its own grey, sRGB, with alpha 0.5: the radiance is twice the linear grey.
std::uint8_t greyOf(std::size_t face) {
    return static_cast<std::uint8_t>(40 + 35 * face);
}
double radianceOfGrey(std::size_t face) {
    return std::pow((greyOf(face) / 255.0 + 0.055) / 1.055, 2.4) / (128 / 255.0);
}

// The triangle's file with a light of six images beside it.
GltfFile withCube(Json light = Json::object()) {
    GltfFile f = GltfFile::triangle();
    for (std::size_t face = 0; face < 6; ++face) {
        std::vector<std::uint8_t> rgba;
        for (int i = 0; i < cubeSide * cubeSide; ++i)
            rgba.insert(rgba.end(), {greyOf(face), greyOf(face), greyOf(face), 128});
        const std::string name = fmt::format("face{}.png", face);
        writePng(testFolder() / name, {cubeSide, cubeSide, 4, rgba});
        f.json["images"].push_back({{"uri", name}});
    }
    const Json valid{{"specularImages", {{0, 1, 2, 3, 4, 5}}}, {"specularImageSize", cubeSide}};
    for (const auto& [key, value] : valid.items())
        if (!light.contains(key)) light[key] = value;
    f.json["extensionsUsed"] = {"EXT_lights_image_based"};
    f.json["extensions"]["EXT_lights_image_based"]["lights"] = Json::array({light});
    f.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return f;
}

double seenTowards(const Scene& scene, const glm::dvec3& d) {
    return reference::EnvironmentLight(*scene.environment, 1).radiance(d).g;
}

TEST(GltfImageLight, HasAFaceInEachDirection) {
    GltfFile file = withCube({{"intensity", 1.5}, {"name", "sky"}});
    file.json["extensionsRequired"] = {"EXT_lights_image_based"};
    const Scene scene = file.load();
    ASSERT_TRUE(scene.environment);
    EXPECT_TRUE(scene.notes.empty()) << scene.notes[0];
    EXPECT_EQ(scene.environment->radiance.width, 4 * cubeSide);
    EXPECT_EQ(scene.environment->radiance.height, 2 * cubeSide);
    EXPECT_EQ(scene.environment->name, "EXT_lights_image_based: light 0");
    for (std::size_t face = 0; face < 6; ++face)
        EXPECT_NEAR(seenTowards(scene, cubeAxes[face]), 1.5 * radianceOfGrey(face), 1e-5) << face;
    EXPECT_FALSE(GltfFile::triangle().load().environment);
}

// Rotation by 90 degrees around +Y, counter-clockwise seen from above: +X moves to -Z, -Z to -X and so on.
TEST(GltfImageLight, IsRotated) {
    const Scene scene = withCube({{"rotation", {0, 2 * std::sqrt(0.5), 0, 2 * std::sqrt(0.5)}}}).load();
    for (const auto& [towards, face] : {std::pair{5, 0}, {1, 5}, {4, 1}, {0, 4}, {2, 2}, {3, 3}})
        EXPECT_NEAR(seenTowards(scene, cubeAxes[static_cast<std::size_t>(towards)]),
                    radianceOfGrey(static_cast<std::size_t>(face)), 1e-5)
            << towards;
}

// Corners of each face seen from inside, in the file's axes: top left, top right, bottom left.
const std::array<std::array<glm::dvec3, 3>, 6> cubeCorners{{{{{1, 1, -1}, {1, 1, 1}, {1, -1, -1}}},
                                                            {{{-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}}},
                                                            {{{1, 1, -1}, {-1, 1, -1}, {1, 1, 1}}},
                                                            {{{1, -1, 1}, {-1, -1, 1}, {1, -1, -1}}},
                                                            {{{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}}},
                                                            {{{-1, 1, -1}, {1, 1, -1}, {-1, -1, -1}}}}};

// Directions stored as colours are read back, also on edges and at corners. Within a texel of 5.6 degrees
// they deviate from linear by up to 1e-3, and by 0.05 where the next face's nearest texel is used.
TEST(CubeMap, EveryDirectionIsWhereItIsSeenFromWithin) {
    CubeMap cube{cubeSide};
    for (std::size_t face = 0; face < 6; ++face) {
        const auto& [corner, right, below] = cubeCorners[face];
        cube.faces[face] = Image(cubeSide, cubeSide, 3);
        for (int y = 0; y < cubeSide; ++y)
            for (int x = 0; x < cubeSide; ++x) {
                const glm::dvec3 d = glm::normalize(corner + (right - corner) * ((x + 0.5) / cubeSide) +
                                                    (below - corner) * ((y + 0.5) / cubeSide));
                for (int c = 0; c < 3; ++c)
                    cube.faces[face].at(x, y, c) = static_cast<float>(0.5 + 0.5 * d[c]);
            }
    }
    double sum = 0, worst = 0;
    const auto tryOne = [&](const glm::dvec3& direction) {
        const glm::dvec3 d = glm::normalize(direction);
        const double off = glm::length(2.0 * radianceOf(cube, direction) - 1.0 - d);
        sum += off;
        worst = std::max(worst, off);
    };
    constexpr int count = 2000;
    for (int i = 0; i < count; ++i) {
        const double y = 1 - (2 * i + 1.0) / count, across = std::sqrt(1 - y * y), turn = 2.4 * i;
        tryOne({across * std::cos(turn), y, across * std::sin(turn)});
    }
    EXPECT_LT(sum / count, 2e-3);
    for (const auto& corners : cubeCorners)
        for (const glm::dvec3& corner : corners) tryOne(3.0 * corner);
    EXPECT_LT(worst, 0.05);
    // A latitude-longitude image; each pixel is a mean over its area.
    const Image image = latLongOf(cube, glm::dmat3(1));
    const Environment sky{"", image};
    const reference::EnvironmentLight light(sky, 1);
    for (const glm::dvec3& d : cubeAxes) EXPECT_LT(glm::length(2.0 * light.radiance(d) - 1.0 - d), 0.01);
}

TEST(GltfImageLight, AnAlphaOf0IsNothingAndSixteenBitsAreKept) {
    TextureImage rgbd{"", 2, 1, {}};
    rgbd.rgba16 = {65535, 32768, 0, 65535, 65535, 65535, 65535, 0};
    const Image image = decodedRgbd(rgbd);
    EXPECT_EQ(image.at(0, 0, 0), 1);
    EXPECT_NEAR(image.at(0, 0, 1), 0.21405, 1e-5);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(1, 0, c), 0);
}

TEST(GltfImageLight, WhatIsBeyondAHalfIsLimited) {
    const Scene scene = withCube({{"intensity", 1e11}}).load();
    EXPECT_EQ(*std::ranges::max_element(scene.environment->radiance.data), 65504);
    EXPECT_TRUE(
        mentions(scene.notes, "EXT_lights_image_based: light 0: 2048 pixels have components above 65504"));
}

TEST(GltfImageLight, WhatIsWrongLeavesItOutWithANote) {
    const auto light = [](GltfFile& f) -> Json& {
        return f.json["extensions"]["EXT_lights_image_based"]["lights"][0];
    };
    using Change = std::function<void(GltfFile&)>;
    const std::pair<const char*, Change> cases[] = {
        {"light 0: intensity", [&](GltfFile& f) { light(f)["intensity"] = -1; }},
        {"light 0: intensity", [&](GltfFile& f) { light(f)["intensity"] = "bright"; }},
        {"light 0: rotation",
         [&](GltfFile& f) {
             light(f)["rotation"] = {0, 0, 1};
         }},
        {"light 0: rotation: has no direction",
         [&](GltfFile& f) {
             light(f)["rotation"] = {0, 0, 0, 0};
         }},
        {"light 0: specularImages", [&](GltfFile& f) { light(f)["specularImages"] = Json::array(); }},
        {"light 0: specularImages", [&](GltfFile& f) { light(f)["specularImages"] = 3; }},
        {"light 0: specularImages",
         [&](GltfFile& f) {
             light(f)["specularImages"][0] = {0, 1, 2, 3, 4};
         }},
        {"image of face 5: is not a whole number below 6",
         [&](GltfFile& f) { light(f)["specularImages"][0][5] = 6; }},
        {"image of face 2: is not a whole number below 6",
         [&](GltfFile& f) { light(f)["specularImages"][0][2] = -1; }},
        {"image of face 0: is not a whole number below 6",
         [&](GltfFile& f) { light(f)["specularImages"][0][0] = nullptr; }},
        {"scene 0: EXT_lights_image_based: light: is not a whole number below 1",
         sets("/scenes/0/extensions/EXT_lights_image_based/light", 1)},
        {"scene 0: EXT_lights_image_based: names no light",
         sets("/scenes/0/extensions/EXT_lights_image_based", 0)},
        {"below 0", sets("/extensions/EXT_lights_image_based", {{"lights", 5}})},
        {"below 0", erases("/extensions", "EXT_lights_image_based")},
        {"light 0", [&](GltfFile& f) { light(f) = "sky"; }},
        {"light 0: image 3: face3.png",
         [](GltfFile&) { std::filesystem::remove(testFolder() / "face3.png"); }},
        {"light 0: image 1: has no uri or bufferView", sets("/images/1", Json::object())},
        {"light 0: image 4: is not PNG, JPEG or WebP", sets("/images/4/uri", "data:image/png;base64,AAAA")},
        {"light 0: image 2: has 2 x 1 pixels", sets("/images/2/uri", twoPixels)},
        {"light 0: image 1: has 4 pixels per side, but the first face 16",
         [](GltfFile&) {
             writePng(testFolder() / "face1.png", {4, 4, 3, std::vector<std::uint8_t>(48, 9)});
         }},
    };
    for (const auto& [why, change] : cases) {
        GltfFile file = withCube();
        change(file);
        const Scene scene = file.load();
        EXPECT_FALSE(scene.environment) << why;
        ASSERT_EQ(scene.notes.size(), 1u) << why;
        EXPECT_NE(scene.notes[0].find(why), std::string::npos) << scene.notes[0];
        EXPECT_NE(scene.notes[0].find("EXT_lights_image_based"), std::string::npos) << scene.notes[0];
        EXPECT_TRUE(scene.notes[0].ends_with(": left out")) << scene.notes[0];
    }
}

TEST(GltfImageLight, KtxCubesAreNamed) {
    GltfFile file = GltfFile::triangle();
    file.json["extensionsUsed"] = {"KHR_lights_image_based"};
    EXPECT_EQ(file.load().notes,
              (std::vector<std::string>{
                  "KHR_lights_image_based: left out, not supported; --env FILE sets an environment"}));
}

}  // namespace
}  // namespace diptych
