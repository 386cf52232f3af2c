// SPDX-License-Identifier: MIT
// A Frame's metadata on its scene, camera and times, and on a reference's uncertainty.
#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"

#include "compare/metrics/channel.h"
#include "compare/render/reference_frame.h"
#include "tests/support/reference_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <limits>

namespace diptych {
namespace {

TEST(FrameProperties, TheMedianIsTheMiddleOrHalfwayBetweenTheMiddleTwo) {
    const FrameTime odd = timeOf({9, 1, 4});
    EXPECT_EQ(odd.median, 4);
    EXPECT_EQ(odd.min, 1);
    EXPECT_EQ(odd.max, 9);
    EXPECT_EQ(odd.runs, 3);
    const FrameTime even = timeOf({16, 1, 9, 4});
    EXPECT_EQ(even.median, 6.5);
    EXPECT_EQ(even.min, 1);
    EXPECT_EQ(even.max, 16);
    EXPECT_EQ(timeOf({2, 4}).median, 3);
    EXPECT_EQ(timeOf({7}).median, 7);
    EXPECT_EQ(timeOf({}).runs, 0);
    EXPECT_EQ(timeOf({}).median, 0);
}

TEST(FrameProperties, APixelWithOneComponentThatIsNoNumberOrInfiniteCountsOnce) {
    constexpr float infinity = std::numeric_limits<float>::infinity(),
                    nan = std::numeric_limits<float>::quiet_NaN();
    Image image(3, 2, 3, 0.5f);
    EXPECT_EQ(nonfinitePixels(image), 0u);
    image.at(0, 0, 0) = nan;
    EXPECT_EQ(nonfinitePixels(image), 1u);
    image.at(1, 0, 1) = infinity;
    EXPECT_EQ(nonfinitePixels(image), 2u);
    image.at(2, 1, 2) = -infinity;
    EXPECT_EQ(nonfinitePixels(image), 3u);
    image.at(2, 1, 0) = nan;
    EXPECT_EQ(nonfinitePixels(image), 3u);
    image.at(1, 1, 0) = std::numeric_limits<float>::max();
    EXPECT_EQ(nonfinitePixels(image), 3u);
}

// Radiance clamped by a small format is reported, whether it becomes the largest number or infinity.
TEST(FrameProperties, RadianceBeyondItsFormatIsSaid) {
    Image image(3, 1, 3, 1.0f);
    EXPECT_FALSE(overflowText(image, LitFormat::fp16));
    image.pixel(1)[2] = 65504;
    image.pixel(2)[0] = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(overflowText(image, LitFormat::fp32));
    EXPECT_EQ(overflowText(image, LitFormat::fp16).value_or(""),
              "lit: clamped to the range of fp16 at 2 pixels; use --lit-format fp32");
    image.pixel(1)[2] = 64512;  // largest value with 10 bits
    EXPECT_NE(overflowText(image, LitFormat::b10g11r11).value_or("").find("2 pixels"), std::string::npos);
    image.pixel(1)[2] = 64000;
    EXPECT_NE(overflowText(image, LitFormat::b10g11r11).value_or("").find("1 pixel;"), std::string::npos);
}

TEST(FrameProperties, WhatIsNoNumberIsRepairedAndNamed) {
    constexpr float infinity = std::numeric_limits<float>::infinity(),
                    max = std::numeric_limits<float>::max();
    Image image(3, 2, 3, 0.5f);
    EXPECT_TRUE(replaceNonfinite(image).empty());
    image.at(1, 0, 1) = infinity;
    image.at(2, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    image.at(2, 1, 2) = -infinity;
    EXPECT_EQ(replaceNonfinite(image), (std::vector<std::uint32_t>{1, 5}));
    EXPECT_EQ(nonfinitePixels(image), 0u);
    EXPECT_EQ(image.at(1, 0, 0), 0.5f) << "the other components stay";
    EXPECT_EQ(image.at(1, 0, 1), max);
    EXPECT_EQ(image.at(2, 1, 0), 0.0f);
    EXPECT_EQ(image.at(2, 1, 2), -max);

    Frame frame;
    recordNonfinite(frame, Channel::normals, {});
    EXPECT_TRUE(frame.repaired.empty());
    recordNonfinite(frame, Channel::normals, {1, 5});
    recordNonfinite(frame, Channel::normals, {0, 5, 7});
    EXPECT_EQ(frame.repaired.at(Channel::normals), (std::vector<std::uint32_t>{0, 1, 5, 7}));
}

TEST(FrameProperties, ACameraIsStatedInDegreesOrAsAHeight) {
    View view;
    view.camera.name = "door";
    view.camera.world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(1, 2, 3), glm::dvec3(1, 2, -4), glm::dvec3(0, 1, 0)));
    view.camera.yfov = glm::radians(40.0);
    view.camera.ymag = 2.5;
    view.camera.near = 0.25;
    view.camera.far = 50;
    view.target_distance = 7;
    FrameCamera camera = cameraOf(view);
    EXPECT_EQ(camera.name, "door");
    EXPECT_NEAR(camera.fov_degrees, 40, 1e-12);
    EXPECT_EQ(camera.ymag, 0) << "its height depends on the distance";
    EXPECT_EQ(camera.near, 0.25);
    EXPECT_EQ(camera.far, 50);
    const double eye[] = {1, 2, 3}, target[] = {1, 2, -4}, up[] = {0, 1, 0};
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(camera.eye[i], eye[i], 1e-12) << i;
        EXPECT_NEAR(camera.target[i], target[i], 1e-12) << i;
        EXPECT_NEAR(camera.up[i], up[i], 1e-12) << i;
    }
    view.camera.orthographic = true;
    camera = cameraOf(view);
    EXPECT_EQ(camera.fov_degrees, 0);
    EXPECT_EQ(camera.ymag, 2.5);
}

TEST(FrameProperties, AViewIsAskedForByItsSettings) {
    Settings settings;
    settings.time = 1.5;
    settings.animation = "walk";
    settings.camera = "2";
    settings.size = {64, 48};
    settings.lights = "point:4";
    settings.seed = 9;
    const ViewRequest request = viewRequest(settings);
    EXPECT_EQ(request.time, 1.5);
    EXPECT_EQ(request.animation, "walk");
    EXPECT_EQ(request.camera, "2");
    EXPECT_EQ(request.width, 64);
    EXPECT_EQ(request.height, 48);
    EXPECT_EQ(request.lights, "point:4");
    EXPECT_EQ(request.seed, 9u);
}

TEST(FrameProperties, AFrameSaysWhatIsKnownBeforeItIsDrawn) {
    Scene scene;
    scene.name = "a.glb";
    scene.background = {0.25f, 0.5f, 0.75f};
    scene.notes = {"a light was left out"};
    SceneView view;
    view.lights.resize(3);
    view.pose.notes = {"an instance was left out at 1 s"};
    Settings settings;
    settings.path = Path::deferred;
    const Frame frame = describedFrame(scene, view, settings);
    EXPECT_EQ(frame.name, "deferred");
    EXPECT_EQ(frame.scene, "a.glb");
    EXPECT_EQ(frame.settings, settings);
    EXPECT_EQ(frame.background, (std::array<float, 3>{0.25f, 0.5f, 0.75f}));
    EXPECT_EQ(frame.notes,
              (std::vector<std::string>{"a light was left out", "an instance was left out at 1 s"}));
    EXPECT_EQ(frame.counters.lights, 3u);
    view.view.width = view.view.height = 90;
    view.view.wider_frame = 2;
    EXPECT_EQ(describedFrame(scene, view, settings).notes.back(),
              "the camera's aspect ratio is 2:1, the picture's 1:1: more is visible above and below, and "
              "nothing is cropped");
    view.view.wider_frame = 0;
    view.default_view = "from above";
    EXPECT_EQ(describedFrame(scene, view, settings).notes.back(),
              "the scene has no camera: viewed from above; --camera chooses another view");
}

// A floor under a sampled environment. The stated relative uncertainty covers 999 of 1000 pixels (nearest
// rank): nearly all of these, not half of them.
TEST(FrameProperties, AReferenceStatesTheUncertaintyOfNearlyAllPixels) {
    Scene scene = reference::floorScene();
    scene.environment = Environment{"sky", Image(8, 4, 3, 0.25f)};
    for (int c = 0; c < 3; ++c) scene.environment->radiance.at(3, 0, c) = 50;
    scene.materials[0].roughness = 0.2f;
    scene.materials[0].specular = 1;
    SceneView view;
    view.pose = poseAt(scene, 0);
    view.view = reference::viewFrom({0, 0, 3}, {0, 9, 1}, 12, 8);
    Settings settings;
    settings.path = Path::reference;
    settings.reference_mode = ReferenceMode::scene;
    settings.size = {12, 8};
    RenderOptions options;
    options.channels = {Channel::lit, Channel::material_id};
    const Frame frame = drawReferenceFrame(scene, view, settings, nullptr, options);
    ASSERT_EQ(frame.uncertainty.pixels(), 96u);
    const Image& lit = frame.channels.at(Channel::lit);
    const PixelError relative(ErrorKind::relative, ChannelKind::color, lit, coverage(frame, frame));
    std::vector<double> all;
    for (std::size_t i = 0; i < lit.pixels(); ++i)
        if (frame.channels.at(Channel::material_id).data[i] >= 0)
            all.push_back(double{frame.uncertainty.data[i]} /
                          std::max(double{std::max({lit.pixel(i)[0], lit.pixel(i)[1], lit.pixel(i)[2]})},
                                   relative.floor()));
    ASSERT_GT(all.size(), 20u);
    ASSERT_LT(all.size(), 96u) << "there is background, which does not count";
    std::ranges::sort(all);
    EXPECT_EQ(frame.relative_uncertainty, all.back()) << "of fewer than 1000 pixels, the largest";
    EXPECT_GT(frame.relative_uncertainty, all[all.size() / 2]);
    EXPECT_EQ(frame.notes.back(), uncertaintyNote(frame.relative_uncertainty));
}

}  // namespace
}  // namespace diptych
