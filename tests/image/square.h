// SPDX-License-Identifier: MIT
// The square whose pixels are known by hand, and helpers to render and check it.
#pragma once

#include "tests/image/scenes.h"
#include "tests/support/shapes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <numbers>
#include <string>
#include <vector>

namespace diptych::tests {

using Channel::albedo, Channel::normals, Channel::metallic, Channel::roughness, Channel::emission,
    Channel::occlusion, Channel::specular;

// Corners (-1, -1) to (1, 1) in z = 0, uv (0, 0) at the top left; camera at (0, 0, 1), 90 degrees.
inline Scene square() {
    Scene scene;
    scene.name = "square";
    Primitive p = rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    p.texcoords[1] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};  // mirrored left to right
    scene.meshes.push_back({"square", {p}});
    scene.nodes.push_back({"square", -1, glm::dmat4(1.0), 0});
    scene.materials.push_back({});
    // Texels: red, green above blue, grey (linear slots read bytes / 255, colour slots decode sRGB).
    scene.images.push_back(
        {"four", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 128, 128, 128, 255}});
    Sampler nearest;
    nearest.magnify_linear = nearest.minify_linear = nearest.mipmaps = nearest.mipmaps_linear = false;
    scene.textures.push_back({0, nearest});
    Camera camera;
    camera.yfov = std::numbers::pi / 2;
    camera.near = 0.1;
    camera.world_from_camera[3] = {0, 0, 1, 1};
    scene.cameras.push_back(camera);
    return scene;
}

// The same square split into cells x cells squares, two triangles each.
inline Scene fineMesh(std::uint32_t cells) {
    Scene scene = square();
    Primitive& p = scene.meshes[0].primitives[0];
    p = {};
    const auto along = [&](std::uint32_t i) {
        return 2.0f * static_cast<float>(i) / static_cast<float>(cells) - 1;
    };
    for (std::uint32_t y = 0; y <= cells; ++y)
        for (std::uint32_t x = 0; x <= cells; ++x) p.positions.emplace_back(along(x), along(y), 0);
    p.normals.assign(p.positions.size(), {0, 0, 1});
    p.tangents.assign(p.positions.size(), {1, 0, 0, 1});
    for (auto& texcoords : p.texcoords) texcoords.assign(p.positions.size(), {0, 0});
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
            p.indices.insert(p.indices.end(), {a, b, d, a, d, c});
        }
    p.material = 0;
    return scene;
}

// Two intersecting squares of different colours. Both cover every pixel of the line; only their depth
// order differs between samples.
inline Scene crossingSquares() {
    Scene scene = square();
    scene.nodes.push_back(
        {"crossing", -1, glm::rotate(glm::dmat4(1.0), glm::radians(30.0), glm::dvec3(0.2, 1, 0)), 0});
    scene.meshes.push_back(scene.meshes[0]);
    scene.materials.push_back({});
    scene.materials[0].emissive = {1, 0, 0};
    scene.materials[1].emissive = {0, 1, 0};
    scene.meshes[1].primitives[0].material = 1;
    scene.nodes[1].mesh = 1;
    return scene;
}

// Frames of both paths at full precision; every expectation is checked on both.
inline std::vector<Frame> draw(const Scene& scene, int pixels = 4) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {pixels, pixels};
    return bothPaths(scene, settings);
}

inline glm::vec3 colorAt(const Frame& frame, Channel channel, int x, int y) {
    const Image& image = frame.channels.at(channel);
    glm::vec3 value(0);
    for (int c = 0; c < image.components; ++c) value[c] = image.at(x, y, c);
    return value;
}

inline void expectColor(const glm::vec3& got, const glm::vec3& expected, float tolerance,
                        const std::string& where) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], tolerance) << where << " component " << c;
}

// sRGB 128 in linear light: ((128/255 + 0.055) / 1.055)^2.4.
constexpr float grey = 0.215861f;
const inline glm::vec3 red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1), greys(grey);
constexpr float float32 = 2e-6f;  // several roundings of values around 1
constexpr float srgbTexel =
    2e-3f;  // a device may decode sRGB to 8 bits' accuracy (Vulkan's texel conversion)

}  // namespace diptych::tests
