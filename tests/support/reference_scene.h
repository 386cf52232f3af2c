// SPDX-License-Identifier: MIT
// Small scenes that tests of the reference render.
#pragma once

#include "tests/support/reference_builder.h"
#include "tests/support/shapes.h"

#include "compare/reference/checkpoint.h"
#include "shared/contract/debug_mode.h"

#include <glm/gtc/matrix_transform.hpp>

#include <optional>

namespace diptych::reference {

// A parallelogram from `corner` along x and y; faces cross(x, y).
inline Primitive quad(const glm::vec3& corner, const glm::vec3& x, const glm::vec3& y, int material = 0) {
    Primitive p = rectangle(corner, x, y, material);
    p.tangents.assign(4, glm::vec4(glm::normalize(x), 1));
    p.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    return p;
}

// White, purely Lambertian.
inline Material matte() {
    Material m;
    m.metallic = 0;
    m.specular = 0;
    return m;
}

// A white 20 m square at z = 0, facing +Z.
inline Scene floorScene() {
    Scene scene;
    scene.materials = {matte()};
    scene.meshes.resize(1);
    scene.meshes[0].primitives = {quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0})};
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    return scene;
}

inline void add(Scene& scene, const Primitive& primitive) {
    scene.meshes[0].primitives.push_back(primitive);
}

inline View viewFrom(const glm::dvec3& eye, const glm::dvec3& target, int width, int height,
                     double yfov = glm::radians(60.0)) {
    View view;
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 up = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    view.camera.world_from_camera = glm::inverse(glm::lookAt(eye, target, up));
    view.camera.yfov = yfov;
    view.camera.near = 0.01;
    view.width = width;
    view.height = height;
    return view;
}

// Checkpoints tiles in files with this stem, owned by `checkpoint`; an empty stem disables it.
inline auto keptAt(const std::filesystem::path& stem, std::optional<Checkpoint>& checkpoint) {
    std::function<Checkpoint&(std::uint64_t, std::size_t)> keep;
    if (!stem.empty())
        keep = [stem, &checkpoint](std::uint64_t key, std::size_t floats) -> Checkpoint& {
            return checkpoint.emplace(stem, key, floats);
        };
    return keep;
}

struct Drawn {
    Pose pose;
    ReferenceImage image;
    const Image& operator[](Channel channel) const { return image.channels.at(channel); }
};
// `shadows`: of every light and of the environment. `keep`: stem of the checkpoint.
inline Drawn drawn(const Scene& scene, const View& view, bool shadows = false, int samples = 1,
                   const std::filesystem::path& keep = {}, const std::function<void(double)>& progress = {}) {
    Drawn result{poseAt(scene, 0), {}};
    std::optional<Checkpoint> checkpoint;
    result.image = draw({.scene = scene,
                         .pose = result.pose,
                         .view = view,
                         .lights = result.pose.lights,
                         .casters = shadows ? everyLight(result.pose.lights) : std::vector<std::size_t>{},
                         .shadowed_environment = shadows,
                         .mode = ReferenceMode::scene,
                         .samples = samples,
                         .surfaces = nullptr,
                         .keep = keptAt(keep, checkpoint),
                         .progress = progress});
    return result;
}

// The same view in mode surface, from `surfaces` as if a path had captured them.
inline ReferenceImage shadedAgain(const Scene& scene, const View& view, const Drawn& traced,
                                  const std::map<Channel, Image>& surfaces, bool shadows = false,
                                  const std::optional<Air>& air = {}) {
    return draw({.scene = scene,
                 .pose = traced.pose,
                 .view = view,
                 .lights = traced.pose.lights,
                 .air = air,
                 .casters = shadows ? everyLight(traced.pose.lights) : std::vector<std::size_t>{},
                 .mode = ReferenceMode::surface,
                 .surfaces = &surfaces});
}

inline glm::dvec3 pixelOf(const Image& image, int x = 0, int y = 0) {
    glm::dvec3 value(0);
    for (int c = 0; c < std::min(image.components, 3); ++c) value[c] = double{image.at(x, y, c)};
    return value;
}
inline void expectColor(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], tolerance) << c;
}

}  // namespace diptych::reference
