// SPDX-License-Identifier: MIT
// Configurable numbers of objects, triangles, meshes, materials and textures in one view. Shows how a
// frame's time and memory grow with each.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/lights/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::builtin {
namespace {

// The objects fill a wall of 16:9, m. The camera sees all of it from eyeDistance with some margin.
constexpr double wallWidth = 16, wallHeight = 9, eyeDistance = 8.5;
constexpr std::uint32_t textureSide = 1024;  // 4 MiB, plus a third for mip levels

// A sphere of about `triangles` triangles, or a square that faces the camera if fewer than 8.
Primitive shapeOf(double radius, double triangles) {
    if (triangles < 8) return quad({-radius, -radius, 0}, {2 * radius, 0, 0}, {0, 2 * radius, 0});
    const int rings = std::max(2, static_cast<int>(std::lround((1 + std::sqrt(1 + triangles)) / 2)));
    return sphere(radius, 2 * rings, rings);
}

// White noise: all textures differ, and so do adjacent texels.
TextureImage noiseTexture(std::uint32_t number) {
    TextureImage image{fmt::format("noise {}", number), int{textureSide}, int{textureSide}, {}};
    image.rgba.resize(std::size_t{textureSide} * textureSide * 4);
    const std::uint32_t seed = pcg(number);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const std::uint32_t bits = pcg(seed + static_cast<std::uint32_t>(i));
        for (std::size_t c = 0; c < 3; ++c)
            image.rgba[i + c] = static_cast<std::uint8_t>(128 + (bits >> 8 * c & 127));
        image.rgba[i + 3] = 255;
    }
    return image;
}

}  // namespace

void array(Builder& b, const ArrayCounts& counts) {
    b.scene.background = {0.02f, 0.02f, 0.03f};
    b.camera("front", {0, 0, eyeDistance}, {0, 0, 0}, 60, 0.1, 100);
    const std::uint32_t objects = std::max(counts.objects, 1u);
    const auto columns =
        std::max(1u, static_cast<std::uint32_t>(std::ceil(std::sqrt(objects * wallWidth / wallHeight))));
    const std::uint32_t rows = (objects + columns - 1) / columns;
    const double cell = std::min(wallWidth / columns, wallHeight / rows);

    const std::uint32_t images = counts.texture_mib / (textureSide * textureSide / (1 << 18));
    const std::uint32_t materials = std::max({counts.materials, images, 1u});
    const std::uint32_t meshes = std::min(std::max({counts.meshes, materials, 1u}), objects);
    for (std::uint32_t m = 0; m < materials && m < meshes; ++m) {
        const glm::vec3 color(static_cast<float>(0.3 + 0.6 * u01(3 * m)),
                              static_cast<float>(0.3 + 0.6 * u01(3 * m + 1)),
                              static_cast<float>(0.3 + 0.6 * u01(3 * m + 2)));
        b.material(fmt::format("material {}", m), {color, 0, static_cast<float>(0.2 + 0.6 * u01(m))});
        if (m < images) b.last().base_color_texture = b.texture(noiseTexture(m));
    }
    const double triangles = static_cast<double>(counts.triangles) / objects;
    for (std::uint32_t m = 0; m < meshes; ++m)  // all meshes differ
        b.addMesh(shapeOf((0.4 + 0.05 * m / meshes) * cell, triangles), static_cast<int>(m % materials),
                  fmt::format("mesh {}", m));
    b.scene.nodes.reserve(objects);
    for (std::uint32_t i = 0; i < objects; ++i) {
        const glm::dvec3 center((i % columns + 0.5 - 0.5 * columns) * cell,
                                (0.5 * rows - i / columns - 0.5) * cell, 0);
        b.addNode(fmt::format("object {}", i), static_cast<int>(i % meshes),
                  glm::translate(glm::dmat4(1.0), center));
    }

    b.sun({-0.3, -0.5, -1}, glm::vec3(1), 1);
    for (std::uint32_t i = 0; i < 16; ++i)
        b.point({(i % 4 - 1.5) * wallWidth / 4, (i / 4 - 1.5) * wallHeight / 4, 1.5}, glm::vec3(1), 2, 4);
}

}  // namespace diptych::builtin
