// SPDX-License-Identifier: MIT
#include "shared/scene/image/cube_map.h"

#include "shared/image/srgb.h"

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace diptych {
namespace {

struct FaceAxes {
    glm::dvec3 forward, right, up;
};
constexpr std::array<FaceAxes, 6> axesOfFaces{{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                               {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                               {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                               {{0, -1, 0}, {-1, 0, 0}, {0, 0, 1}},
                                               {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
                                               {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}};

// A position on a face, in texels from its left and top edges.
struct FacePosition {
    std::size_t face;
    double x, y;
};

FacePosition facePosition(const CubeMap& cube, const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const std::size_t face = 2 * static_cast<std::size_t>(axis) + (d[axis] < 0 ? 1 : 0);
    const FaceAxes& axes = axesOfFaces[face];
    return {face, (glm::dot(d, axes.right) / a[axis] + 1) / 2 * cube.side,
            (1 - glm::dot(d, axes.up) / a[axis]) / 2 * cube.side};
}

glm::dvec3 directionOf(const CubeMap& cube, const FacePosition& position) {
    const FaceAxes& axes = axesOfFaces[position.face];
    return axes.forward + axes.right * (2 * position.x / cube.side - 1) -
           axes.up * (2 * position.y / cube.side - 1);
}

// Coordinates beyond an edge select the texel of the adjacent face in that direction.
glm::dvec3 texelOf(const CubeMap& cube, std::size_t face, int x, int y) {
    if (x < 0 || y < 0 || x >= cube.side || y >= cube.side) {
        const FacePosition there = facePosition(cube, directionOf(cube, {face, x + 0.5, y + 0.5}));
        face = there.face;
        x = std::clamp(static_cast<int>(there.x), 0, cube.side - 1);
        y = std::clamp(static_cast<int>(there.y), 0, cube.side - 1);
    }
    const Image& image = cube.faces[face];
    return {double{image.at(x, y, 0)}, double{image.at(x, y, 1)}, double{image.at(x, y, 2)}};
}

}  // namespace

glm::dvec3 radianceOf(const CubeMap& cube, const glm::dvec3& direction) {
    const FacePosition at = facePosition(cube, direction);
    const double left = std::floor(at.x - 0.5), top = std::floor(at.y - 0.5);
    const double fx = at.x - 0.5 - left, fy = at.y - 0.5 - top;
    const int x = static_cast<int>(left), y = static_cast<int>(top);
    return (texelOf(cube, at.face, x, y) * (1 - fx) + texelOf(cube, at.face, x + 1, y) * fx) * (1 - fy) +
           (texelOf(cube, at.face, x, y + 1) * (1 - fx) + texelOf(cube, at.face, x + 1, y + 1) * fx) * fy;
}

Image latLongOf(const CubeMap& cube, const glm::dmat3& cube_from_world) {
    constexpr int samples_per_axis = 2;  // samples per axis
    using std::numbers::pi;
    Image image(4 * cube.side, 2 * cube.side, 3);
    tbb::parallel_for(0, image.height, [&](int y) {
        for (int x = 0; x < image.width; ++x) {
            glm::dvec3 sum(0);
            for (int k = 0; k < samples_per_axis * samples_per_axis; ++k) {
                const double azimuth = 2 * pi * (x + (k % samples_per_axis + 0.5) / samples_per_axis) /
                                           image.width -
                                       pi,
                             polar =
                                 pi * (y + (k / samples_per_axis + 0.5) / samples_per_axis) / image.height;
                sum += radianceOf(
                    cube, cube_from_world * glm::dvec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                                       -std::sin(polar) * std::cos(azimuth)));
            }
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = static_cast<float>(sum[c] / (samples_per_axis * samples_per_axis));
        }
    });
    return image;
}

Image decodedRgbd(const TextureImage& rgbd) {
    Image image(rgbd.width, rgbd.height, 3);
    const bool deep = !rgbd.rgba16.empty();
    const auto component = [&](std::size_t i) {
        return deep ? rgbd.rgba16[i] / 65535.0 : rgbd.rgba[i] / 255.0;
    };
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const double alpha = component(4 * i + 3);
        for (std::size_t c = 0; c < 3; ++c)
            image.pixel(i)[c] =
                alpha > 0 ? static_cast<float>(linearFromSrgb(component(4 * i + c)) / alpha) : 0.0f;
    }
    return image;
}

}  // namespace diptych
