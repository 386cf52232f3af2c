// SPDX-License-Identifier: MIT
// The camera that keys and the mouse move.
#include "compare/viewer/window/fly_camera.h"

#include "compare/frames/frame_properties.h"
#include "shared/scene/scene_view.h"
#include "tests/support/plain_builtin.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace diptych::viewer {
namespace {

FrameCamera cameraAt(const glm::dvec3& eye, const glm::dvec3& target) {
    FrameCamera camera;
    for (int i = 0; i < 3; ++i) {
        camera.eye[i] = eye[i];
        camera.target[i] = target[i];
    }
    camera.fov_degrees = 40;
    camera.near = 0.1;
    camera.far = std::numeric_limits<double>::infinity();
    return camera;
}

// The view that --camera makes of the words; the viewer draws it.
View viewOf(const FlyCamera& camera) {
    const Scene& scene = plainBuiltin("gallery");
    ViewRequest request;
    request.camera = camera.describe();
    request.width = 64;
    request.height = 36;
    return makeSceneView(scene, request).view;
}

TEST(ViewerCamera, ItsWordsAreTheCameraThatItTookOver) {
    FlyCamera camera;
    EXPECT_FALSE(camera.canMove());
    const glm::dvec3 eye(1.25, 3.5, -7.125), target(0.5, 1, 2);
    camera.take(cameraAt(eye, target));
    ASSERT_TRUE(camera.canMove());
    const View view = viewOf(camera);
    EXPECT_LT(glm::distance(view.eye(), eye), 1e-7);
    EXPECT_LT(glm::distance(-view.backward(), glm::normalize(target - eye)), 1e-7);
    EXPECT_DOUBLE_EQ(view.camera.near, 0.1);
    EXPECT_TRUE(std::isinf(view.camera.far));
    EXPECT_NEAR(view.camera.yfov * 180 / std::numbers::pi, 40, 1e-9);
}

TEST(ViewerCamera, AnOrthographicOneHasNoWords) {
    FlyCamera camera;
    FrameCamera orthographic = cameraAt({0, 0, 1}, {0, 0, 0});
    orthographic.fov_degrees = 0;
    orthographic.ymag = 2;
    camera.take(orthographic);
    EXPECT_FALSE(camera.canMove());
}

TEST(ViewerCamera, MovesAlongItsRightTheWorldsUpAndItsView) {
    FlyCamera camera;
    camera.take(cameraAt({0, 0, 0}, {0, 0, -2}));
    camera.move({1, 2, 3});
    EXPECT_LT(glm::distance(camera.eye(), glm::dvec3(1, 2, -3)), 1e-12);
    camera.look(std::numbers::pi / 2, 0);  // right, towards +X
    EXPECT_LT(glm::distance(camera.forward(), glm::dvec3(1, 0, 0)), 1e-12);
    camera.look(0, 10);
    EXPECT_GT(camera.forward().y, 0.99) << "looks up";
    EXPECT_LT(camera.forward().y, 1.0) << "but not straight, where right has no meaning";
}

TEST(ViewerCamera, WhatItOrbitsStaysWhereItIsInTheImage) {
    FlyCamera camera;
    camera.take(cameraAt({0, 1, 5}, {0, 1, 0}));
    const glm::dvec3 pivot(0.5, 0.25, 1);
    const auto seen = [&] {
        const glm::dvec3 to = pivot - camera.eye(), up = glm::cross(camera.right(), camera.forward());
        return glm::dvec3(glm::dot(to, camera.right()), glm::dot(to, up), glm::dot(to, camera.forward()));
    };
    const glm::dvec3 before = seen(), eye = camera.eye();
    camera.orbit(pivot, 0.7, 0.3);
    EXPECT_LT(glm::distance(before, seen()), 1e-12);
    EXPECT_GT(glm::distance(eye, camera.eye()), 1);
}

}  // namespace
}  // namespace diptych::viewer
