// SPDX-License-Identifier: MIT
#include "shared/scene/view.h"
#include "shared/scene/motion/bounds.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

using namespace diptych;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The unit square around `centre`, parallel to z = 0, facing +Z.
Scene squareAt(const glm::dvec3& centre, bool doubleSided = false, double mirror = 1) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = doubleSided;
    scene.meshes.push_back({"square", {rectangle({-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0})}});
    Node node;
    node.mesh = 0;
    node.parent_from_node =
        glm::translate(glm::dmat4(1), centre) * glm::scale(glm::dmat4(1), glm::dvec3(1, 1, mirror));
    scene.nodes.push_back(node);
    return scene;
}

View viewOf(const Scene& scene, const std::string& choice, int width = 640, int height = 360) {
    return makeView(scene, poseAt(scene, 0), choice, width, height);
}

std::string viewFault(const std::string& choice, const Scene& scene = squareAt({0, 0, 0})) {
    return faultOf([&] { viewOf(scene, choice); });
}

// The shaders' use of gpu::View: from a pixel and its depth to a position, in float.
glm::vec3 reconstruct(const gpu::View& v, const glm::vec2& pixel, float z) {
    const float d =
        (v.depth_numerator.x + v.depth_numerator.y * z) / (v.depth_denominator.x + v.depth_denominator.y * z);
    const glm::vec3 origin = v.origin_0 + v.origin_x * pixel.x + v.origin_y * pixel.y;
    const glm::vec3 direction = v.direction_0 + v.direction_x * pixel.x + v.direction_y * pixel.y;
    return origin + direction * d;
}

Camera tiltedCamera(bool orthographic, double near, double far) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.yfov = 0.9;
    camera.ymag = 3;
    camera.near = near;
    camera.far = far;
    camera.world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(3, 4, 5), glm::dvec3(-1, 0.5, 2), glm::dvec3(0, 1, 0)));
    return camera;
}

}  // namespace

// By hand: fov 90 gives tan(fov / 2) = 1; 200 x 100 has an aspect of 2; n = 1, f = 3: n/(f-n) = 0.5,
// nf/(f-n) = 1.5.
TEST(View, PerspectiveMatrixByHand) {
    View view{Camera{}, 200, 100};
    view.camera.yfov = std::acos(0.0);
    view.camera.near = 1;
    view.camera.far = 3;
    const glm::dmat4 m = view.clipFromWorld();
    const double expected[4][4] = {
        {0.5, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 0.5, -1}, {0, 0, 1.5, 0}};  // columns
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(m[c][r], expected[c][r], 1e-15) << c << r;

    const gpu::View gpu = view.gpuView();
    EXPECT_FLOAT_EQ(gpu.depth_numerator.x, 1.5f);
    EXPECT_FLOAT_EQ(gpu.depth_denominator.x, 0.5f);
    // The top left corner, one metre away: 2 m to the left, 1 m up.
    EXPECT_NEAR(gpu.direction_0.x, -2, 1e-6);
    EXPECT_NEAR(gpu.direction_0.y, 1, 1e-6);
    EXPECT_NEAR(gpu.direction_0.z, -1, 1e-6);
    EXPECT_NEAR(gpu.direction_x.x, 0.02, 1e-8);  // 4 m over 200 pixels
    EXPECT_NEAR(gpu.direction_y.y, -0.02, 1e-8);
    EXPECT_EQ(gpu.origin_0, gpu::vec3(0));
}

TEST(View, InfiniteMatrixByHand) {
    View view{Camera{}, 100, 100};
    view.camera.yfov = std::acos(0.0);
    view.camera.near = 0.25;
    const glm::dmat4 m = view.clipFromWorld();
    EXPECT_EQ(m[2][2], 0);
    EXPECT_EQ(m[3][2], 0.25);
    const glm::dvec4 near = m * glm::dvec4(0, 0, -0.25, 1), away = m * glm::dvec4(0, 0, -1e9, 1);
    EXPECT_DOUBLE_EQ(near.z / near.w, 1);
    EXPECT_DOUBLE_EQ(away.z / away.w, 0.25e-9);
    EXPECT_EQ(view.gpuView().depth_numerator, gpu::vec2(0.25f, 0));
    EXPECT_EQ(view.gpuView().depth_denominator, gpu::vec2(0, 1));
}

// By hand: half the height is 2, half the width 4; n = 1, f = 5: z = (f - d) / 4.
TEST(View, OrthographicMatrixByHand) {
    View view{Camera{}, 200, 100};
    view.camera.orthographic = true;
    view.camera.ymag = 2;
    view.camera.near = 1;
    view.camera.far = 5;
    const glm::dvec4 clip = view.clipFromWorld() * glm::dvec4(4, 2, -1, 1);
    EXPECT_DOUBLE_EQ(clip.x, 1);
    EXPECT_DOUBLE_EQ(clip.y, -1);
    EXPECT_DOUBLE_EQ(clip.z, 1);
    EXPECT_DOUBLE_EQ(clip.w, 1);
    EXPECT_DOUBLE_EQ((view.clipFromWorld() * glm::dvec4(0, 0, -5, 1)).z, 0);
    const gpu::View gpu = view.gpuView();
    EXPECT_EQ(gpu.direction_x, gpu::vec3(0));
    EXPECT_EQ(gpu.depth_numerator, gpu::vec2(5, -4));
}

// From world to clip space, pixel and float depth and back, over the whole image and all depths.
TEST(View, PixelAndDepthGiveThePositionBack) {
    struct Case {
        bool orthographic;
        double near, far;
    };
    for (const Case c : {Case{false, 0.1, 1000}, Case{false, 0.1, infinity}, Case{false, 1, 1.5},
                         Case{true, 0, 50}, Case{true, 2, 9}})
        for (const auto& [width, height] : {std::pair{640, 360}, {1, 1}, {4097, 3}, {3, 4097}}) {
            const View view{tiltedCamera(c.orthographic, c.near, c.far), width, height};
            const gpu::View gpu = view.gpuView();
            const glm::dmat4 clipFromWorld = view.clipFromWorld();
            const glm::dmat4 worldFromClip = glm::inverse(clipFromWorld);
            for (const double x : {0.5, width * 0.3, width - 0.5})
                for (const double y : {0.5, height * 0.7, height - 0.5})
                    for (const double z : {1.0, 0.75, 0.1, 1e-3, 0.0}) {
                        if (z == 0 && std::isinf(c.far)) continue;
                        glm::dvec4 world =
                            worldFromClip * glm::dvec4(2 * x / width - 1, 2 * y / height - 1, z, 1);
                        const glm::dvec3 position = glm::dvec3(world) / world.w;
                        const glm::vec3 back = reconstruct(gpu, {x, y}, static_cast<float>(z));
                        // A dozen roundings of 6e-8 of the largest summand: half the image's width times
                        // the depth (4097 x 3 spans 1366 times its height).
                        const double span =
                            std::max(1.0, 1.0 * width / height) *
                            std::max({glm::length(position), 1.0, c.orthographic ? c.far : 0.0});
                        EXPECT_NEAR(glm::length(glm::dvec3(back) - position), 0, 12 * 6e-8 * span)
                            << width << "x" << height << " at " << x << " " << y << " " << z;
                        // The depth along the axis is the near or far distance.
                        const double depth = -glm::dot(position, view.backward());
                        if (z == 1) {
                            EXPECT_NEAR(depth, c.near, 1e-9 * std::max(span, 1.0));
                        }
                        if (z == 0) {
                            EXPECT_NEAR(depth, c.far, 1e-9 * span);
                        }
                    }
        }
}

TEST(View, ClipSpaceHasYDownAndTheCameraAsOrigin) {
    const View view = viewOf(squareAt({0, 0, 0}), "eye=100,0,10 target=100,0,0");
    const glm::dvec4 above = view.clipFromWorld() * glm::dvec4(0, 1, -10, 1);
    EXPECT_LT(above.y / above.w, 0);
    const glm::dvec4 right = view.clipFromWorld() * glm::dvec4(1, 0, -10, 1);
    EXPECT_GT(right.x / right.w, 0);
}

TEST(View, AxesOfScaledAndMirroredNodesStayOrthonormal) {
    for (const glm::dvec3 scale :
         {glm::dvec3(2, 3, 4), glm::dvec3(-1, 1, 1), glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 1)}) {
        View view{Camera{}, 4, 4};
        view.camera.world_from_camera = glm::scale(glm::dmat4(1), scale);
        EXPECT_NEAR(glm::length(view.right()), 1, 1e-12);
        EXPECT_NEAR(glm::length(view.up()), 1, 1e-12);
        EXPECT_NEAR(glm::dot(view.right(), view.up()), 0, 1e-12);
        EXPECT_NEAR(glm::length(glm::cross(view.right(), view.up()) - view.backward()), 0, 1e-12);
    }
}

TEST(MakeView, DefaultStandsOutsideAndSeesEveryCorner) {
    for (const auto& [width, height] : {std::pair{640, 360}, {100, 900}}) {
        Scene scene = squareAt({10, 20, 30});
        scene.nodes[0].parent_from_node *= glm::scale(glm::dmat4(1), glm::dvec3(40, 3, 1));
        const Pose pose = poseAt(scene, 0);
        const View view = makeView(scene, pose, "", width, height);
        const Bounds bounds = worldBounds(scene, pose);
        const glm::dvec3 away = glm::normalize(glm::dvec3(1, 0.6, 1));
        EXPECT_NEAR(glm::length(view.backward() - away), 0, 1e-12);
        EXPECT_NEAR(glm::length(view.target() - bounds.centre()), 0, 1e-9);
        for (const double x : {bounds.min.x, bounds.max.x})
            for (const double y : {bounds.min.y, bounds.max.y}) {
                const glm::dvec4 clip =
                    view.clipFromWorld() * glm::dvec4(glm::dvec3(x, y, 30) - view.eye(), 1);
                EXPECT_GT(clip.w, 0);
                EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), clip.w);
                EXPECT_LE(clip.z, clip.w) << "not before the near plane";
            }
    }
}

TEST(MakeView, DefaultChangesSidesWhereNothingFacesIt) {
    const glm::dvec3 away = glm::normalize(glm::dvec3(1, 0.6, 1));
    Scene back = squareAt({0, 0, 0});
    std::swap(back.meshes[0].primitives[0].indices[1], back.meshes[0].primitives[0].indices[2]);
    std::swap(back.meshes[0].primitives[0].indices[4], back.meshes[0].primitives[0].indices[5]);
    EXPECT_NEAR(glm::length(viewOf(back, "").backward() + away), 0, 1e-12);
    back.materials[0].double_sided = true;
    EXPECT_NEAR(glm::length(viewOf(back, "").backward() - away), 0, 1e-12);
    // A mirroring node also flips the front: scaled by -1 along z, the square faces -Z.
    EXPECT_NEAR(glm::length(viewOf(squareAt({0, 0, 0}, false, -1), "").backward() + away), 0, 1e-12);
}

TEST(MakeView, EmptyAndPointScenesHaveAView) {
    for (const View& view : {viewOf(Scene{}, ""), viewOf(Scene{}, "fov=40")}) {
        EXPECT_TRUE(std::isfinite(glm::length(view.eye())));
        EXPECT_GT(view.camera.near, 0);
    }
    Scene point = squareAt({1, 2, 3});
    point.nodes[0].parent_from_node *= glm::scale(glm::dmat4(1), glm::dvec3(0));
    EXPECT_GT(glm::length(viewOf(point, "").eye() - glm::dvec3(1, 2, 3)), 0.1);
}

TEST(MakeView, SceneCamerasByDefaultIndexAndName) {
    Scene scene = squareAt({0, 0, 0});
    Node node;
    node.parent_from_node = glm::translate(glm::dmat4(1), glm::dvec3(7, 8, 9));
    scene.nodes.push_back(node);
    Camera first, second;
    first.name = "first";
    first.node = 1;
    second.name = "second one";
    second.world_from_camera = glm::translate(glm::dmat4(1), glm::dvec3(-1, 0, 0));
    scene.cameras = {first, second};
    EXPECT_EQ(viewOf(scene, "").eye(), glm::dvec3(7, 8, 9));
    EXPECT_EQ(viewOf(scene, "0").eye(), glm::dvec3(7, 8, 9));
    EXPECT_EQ(viewOf(scene, "1").eye(), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(viewOf(scene, "second one").eye(), glm::dvec3(-1, 0, 0));
    for (const char* wrong : {"2", "third", "-1"}) {
        const std::string error = viewFault(wrong, scene);
        EXPECT_NE(error.find("--camera"), error.npos) << wrong;
        EXPECT_NE(error.find("second one"), error.npos) << error;
    }
    EXPECT_NE(viewFault("Second on", scene).find("; did you mean second one?"), std::string::npos);
    EXPECT_EQ(viewFault("third", scene).find("did you mean"), std::string::npos);

    // An integer is an index, whatever has that name; other names are the cameras' or their nodes'.
    scene.cameras[0].name = "1";
    scene.cameras[0].node_name = "hero";
    scene.cameras[1].name = "7";
    EXPECT_EQ(viewOf(scene, "1").eye(), glm::dvec3(-1, 0, 0));
    EXPECT_NE(viewFault("7", scene).find("0 \"1\" (node \"hero\"), 1 \"7\"; it takes"), std::string::npos)
        << "an index is not a misspelt name";
    EXPECT_EQ(viewOf(scene, "hero").eye(), glm::dvec3(7, 8, 9));
    scene.cameras[1].name = "hero";
    EXPECT_EQ(viewFault("hero", scene),
              "--camera \"hero\": is the name of 0 (1, hero), 1 (hero, ); give an index");
}

// By hand: for a camera frame of F:1, the frame's corners at depth d are (+-F h, +-h), where h is ymag or
// d tan(yfov / 2). They are inside an image of any shape, at its left and right or top and bottom edges.
// An image that is not narrower keeps the camera's height exactly.
TEST(MakeView, AllThatACameraFramesIsInTheImage) {
    constexpr double yfov = 0.7, ymag = 1.5;
    for (const bool orthographic : {false, true})
        for (const double frame : {0.0, 0.25, 1.0, 16.0 / 9, 3.0})
            for (const auto& [width, height] : {std::pair{160, 90}, {90, 160}, {100, 100}}) {
                Scene scene = squareAt({0, 0, 0});
                Camera& camera = scene.cameras.emplace_back();
                camera.orthographic = orthographic;
                camera.yfov = yfov;
                camera.ymag = ymag;
                camera.far = 100;
                (orthographic ? camera.xmag : camera.aspect) = frame * (orthographic ? ymag : 1);
                const View view = viewOf(scene, "", width, height);
                const std::string what = fmt::format(
                    "{} {}:1 in {}x{}", orthographic ? "parallels" : "perspective", frame, width, height);
                const double image = static_cast<double>(width) / height;
                const bool wider = frame > image;
                EXPECT_EQ(view.wider_frame, wider ? frame : 0) << what;
                EXPECT_EQ(view.camera.yfov == yfov && view.camera.ymag == ymag, !wider) << what;
                for (const double depth : {1.0, 40.0}) {
                    const double half = orthographic ? ymag : depth * std::tan(yfov / 2);
                    const glm::dvec4 corner = view.clipFromWorld() *
                                              glm::dvec4((frame > 0 ? frame : image) * half, half, -depth, 1);
                    const double x = corner.x / corner.w, y = -corner.y / corner.w;
                    EXPECT_NEAR(std::max(x, y), 1, 1e-12) << what;
                    EXPECT_GT(std::min(x, y), 0) << what;
                }
                // A camera made from the view is not widened again.
                Scene again = scene;
                again.cameras = {view.camera};
                EXPECT_EQ(viewOf(again, "", width, height).clipFromWorld(), view.clipFromWorld()) << what;
            }
    // A float32 aspect ratio in the file counts as the image's ratio.
    Scene rounded = squareAt({0, 0, 0});
    rounded.cameras.emplace_back().aspect = double{16.0f / 9.0f};
    EXPECT_EQ(viewOf(rounded, "", 640, 360).wider_frame, 0);
}

TEST(MakeView, ExplicitCamera) {
    const View view = viewOf(squareAt({0, 0, 0}), "target=0,0,0  fov=90 eye=0,0,-2.5 far=100 near=1e-2");
    EXPECT_EQ(view.eye(), glm::dvec3(0, 0, -2.5));
    EXPECT_NEAR(glm::length(view.target()), 0, 1e-12);
    EXPECT_EQ(view.backward(), glm::dvec3(0, 0, -1));
    EXPECT_EQ(view.right(), glm::dvec3(-1, 0, 0));
    EXPECT_NEAR(view.camera.yfov, std::acos(0.0), 1e-15);
    EXPECT_EQ(view.camera.near, 0.01);
    EXPECT_EQ(view.camera.far, 100);
    EXPECT_TRUE(std::isinf(viewOf(squareAt({0, 0, 0}), "far=inf").camera.far));
}

TEST(MakeView, StraightUpAndDownHaveAnUp) {
    const View down = viewOf(Scene{}, "eye=0,5,0 target=0,0,0"),
               up = viewOf(Scene{}, "eye=0,-5,0 target=0,0,0");
    EXPECT_NEAR(glm::length(down.up() - glm::dvec3(0, 0, -1)), 0, 1e-12);
    EXPECT_NEAR(glm::length(down.right() - glm::dvec3(1, 0, 0)), 0, 1e-12);
    EXPECT_NEAR(glm::length(up.up() - glm::dvec3(0, 0, 1)), 0, 1e-12);
    EXPECT_NEAR(glm::length(up.right() - glm::dvec3(1, 0, 0)), 0, 1e-12);
}

TEST(MakeView, BadCamerasAreNamed) {
    for (const char* wrong : {"eye=1,2",
                              "eye=1,2,3,4",
                              "eye=1,nan,3",
                              "eye=1,inf,3",
                              "eye=a,b,c",
                              "eye=1,1,1 target=1,1,1",
                              "fov=0",
                              "fov=180",
                              "fov=nan",
                              "fov=-5",
                              "near=0",
                              "near=-1",
                              "near=inf",
                              "near=2 far=1",
                              "near=1 far=1",
                              "eye=1,2,3 roll=4",
                              "fov=60 fov=70",
                              "eye=1,2,3 up",
                              "fov=",
                              "fov=60x",
                              "eye=1e200,0,0 target=-1e200,0,0"}) {
        const std::string error = viewFault(wrong);
        EXPECT_TRUE(error.starts_with("--camera")) << wrong << ": " << error;
        EXPECT_EQ(error.find('\n'), error.npos);
    }
    EXPECT_THROW(viewOf(Scene{}, "", 0, 5), std::runtime_error);
}
