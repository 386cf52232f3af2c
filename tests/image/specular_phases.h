// SPDX-License-Identifier: MIT
// A scene with cameras that shift its image by fractions of a pixel.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/view.h"
#include "tests/image/scenes.h"

#include <cmath>
#include <numbers>

namespace diptych::tests {

inline constexpr int phases = 64;  // 8 x 8 positions in a pixel

// Appends `phases` cameras to the scene's own: the same eye, rotated so that the image's centre moves by
// -1/2 to 1/2 pixel in both directions. The visible surfaces do not change.
inline Scene withPhases(Scene scene, Size size) {
    const View view = makeView(scene, poseAt(scene, 0), "", size.width, size.height);
    const double pixel = 2 * std::tan(view.camera.yfov / 2) / size.height;  // m per metre of depth
    for (int i = 0; i < phases; ++i) {
        const double x = (i % 8 + 0.5) / 8 - 0.5, y = (i / 8 + 0.5) / 8 - 0.5;
        Camera camera = view.camera;
        camera.node = -1;
        camera.world_from_camera[1] = glm::dvec4(view.up(), 0);
        camera.world_from_camera[2] =
            glm::dvec4(glm::normalize(view.backward() + pixel * (x * view.right() + y * view.up())), 0);
        camera.world_from_camera[3] = glm::dvec4(view.eye(), 1);
        scene.cameras.push_back(camera);
    }
    return scene;
}

// A metal sheet of 1 m with `bumps` x `bumps` bumps that look smooth from afar, under a sun.
inline Scene displacedSheet(int bumps = 4, double slope = 0.5, int cells = 192) {
    Scene scene;
    scene.name = "sheet";
    Primitive p;
    const double wave = 2 * std::numbers::pi * bumps, height = slope / wave;
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const double x = static_cast<double>(column) / cells, z = static_cast<double>(row) / cells;
            const double sx = std::sin(wave * x), cx = std::cos(wave * x);
            const double sz = std::sin(wave * z), cz = std::cos(wave * z);
            p.positions.emplace_back(x - 0.5, height * sx * sz, z - 0.5);
            p.normals.push_back(
                glm::normalize(glm::vec3(-height * wave * cx * sz, 1, -height * wave * sx * cz)));
            p.tangents.push_back({1, 0, 0, 1});
            p.texcoords[0].push_back({x, z});
        }
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const auto at = [&](int r, int c) { return static_cast<std::uint32_t>(r * (cells + 1) + c); };
            for (const std::uint32_t i : {at(row, column), at(row + 1, column), at(row + 1, column + 1),
                                          at(row, column), at(row + 1, column + 1), at(row, column + 1)})
                p.indices.push_back(i);
        }
    scene.meshes.push_back({"sheet", {p}});
    scene.nodes.push_back({"sheet", -1, glm::dmat4(1), 0});
    Material metal;
    metal.roughness = 0.15f;
    metal.base_color = {0.9f, 0.8f, 0.6f, 1};
    scene.materials.push_back(metal);
    scene.lights.push_back(sunAlong(glm::normalize(glm::dvec3(0.05, -0.9, 0.5)), 3));
    Camera camera;
    camera.yfov = glm::radians(40.0);
    camera.near = 0.01;
    camera.world_from_camera[1] = {0, 1, 0, 0};
    camera.world_from_camera[2] = glm::dvec4(glm::normalize(glm::dvec3(0, 0.9, 0.5)), 0);
    camera.world_from_camera[3] = {0, 0.9 * 1.1, 0.5 * 1.1, 1};
    scene.cameras.push_back(camera);
    return scene;
}

// Flicker and mean of a channel's radiance over `phases` images, in the pixels that show one material in
// all of them.
struct Shimmer {
    double rmse = 0;  // root of the mean variance over the phases, of pixels and components
    double mean = 0;
    std::size_t pixels = 0;
};

class Flicker {
public:
    void add(const Frame& frame, Channel channel) {
        const Image &light = frame.channels.at(channel), &id = frame.channels.at(Channel::material_id);
        if (sum_.empty()) {
            sum_.resize(light.data.size()), squares_.resize(light.data.size());
            id_ = id.data;
        }
        for (std::size_t i = 0; i < light.data.size(); ++i) {
            sum_[i] += double{light.data[i]};
            squares_[i] += double{light.data[i]} * double{light.data[i]};
        }
        for (std::size_t i = 0; i < id.data.size(); ++i)
            if (id.data[i] != id_[i]) id_[i] = -1;
        ++count_;
    }
    Shimmer shimmer() const {
        Shimmer result;
        for (std::size_t i = 0; i < id_.size(); ++i) {
            if (id_[i] < 0) continue;
            ++result.pixels;
            for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
                const double mean = sum_[c] / count_;
                result.mean += mean;
                result.rmse += std::max(squares_[c] / count_ - mean * mean, 0.0);
            }
        }
        const double all = 3.0 * static_cast<double>(result.pixels);
        result.rmse = std::sqrt(result.rmse / all);
        result.mean /= all;
        return result;
    }

private:
    std::vector<double> sum_, squares_;
    PixelData id_;
    double count_ = 0;
};

}  // namespace diptych::tests
