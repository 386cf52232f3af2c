// SPDX-License-Identifier: MIT
// A Frame does not depend on when, where and at which size it is rendered.
#include "shared/scene/load.h"
#include "tests/image/scenes.h"

#include <cstdlib>

namespace diptych::tests {
namespace {

TEST(FrameOf, TwoRunsAreTheSameBits) {
    const Scene scene = loadScene("builtin:gallery");
    for (const GBufferEncoding encoding : {GBufferEncoding::standard, GBufferEncoding::full}) {
        const auto first = bothPaths(scene, smallImage(encoding)),
                   second = bothPaths(scene, smallImage(encoding));
        for (std::size_t i = 0; i < 2; ++i)
            for (const auto& [mode, image] : first[i].channels)
                EXPECT_EQ(differingPixels(image, second[i].channels.at(mode), true), 0u)
                    << first[i].name << " " << debugMode(mode).name;
    }
}

// Lavapipe reads LP_NUM_THREADS when a device is created.
TEST(FrameOf, OneThreadAndTwoAreTheSameBits) {
    if (!device().profile().software)
        GTEST_SKIP() << "SKIPPED: LP_NUM_THREADS means nothing to " << device().info().name;
    const Scene scene = loadScene("builtin:gallery");
    std::vector<std::vector<Frame>> frames;
    for (const char* threads : {"1", "2"}) {
        setenv("LP_NUM_THREADS", threads, 1);
        Device fresh{DeviceOptions{}};
        Renderer renderer(fresh, scene);
        frames.push_back(bothPaths(renderer, smallImage(GBufferEncoding::standard)));
    }
    unsetenv("LP_NUM_THREADS");
    for (std::size_t i = 0; i < 2; ++i)
        for (const auto& [mode, image] : frames[0][i].channels)
            EXPECT_EQ(differingPixels(image, frames[1][i].channels.at(mode), true), 0u)
                << debugMode(mode).name;
}

TEST(FrameOf, OnePixelAndVeryWideWork) {
    const Scene scene = loadScene("builtin:gallery");
    for (const Size size : {Size{1, 1}, Size{4097, 3}, Size{3, 4097}}) {
        Settings settings = smallImage(GBufferEncoding::full);
        settings.size = size;
        const auto frames = bothPaths(scene, settings);
        expectSameChannels(frames[0], frames[1]);
        EXPECT_EQ(frames[0].channels.at(Channel::lit).width, size.width);
        EXPECT_EQ(frames[0].channels.at(Channel::lit).height, size.height);
        EXPECT_GT(coveredPixels(frames[0]), 0u);
    }
}

TEST(FrameOf, ASizeBeyondTheDeviceIsRefusedByName) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {1 << 20, 1};
    try {
        bothPaths(loadScene("builtin:triangle"), settings);
        FAIL() << "drew a million pixels wide";
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("--size 1048576x1"), std::string::npos) << e.what();
    }
}

// No stale data: the previous frame must not affect the next.
TEST(FrameOf, InputsThatChangeAreDrawnAfresh) {
    const Scene scene = loadScene("builtin:gallery");
    Settings before = smallImage(GBufferEncoding::standard), after = before;
    after.camera = "eye=1,1.5,2 target=0,1,-3 fov=50";
    after.lights = "point:8";
    const RenderOptions options = untimed(allChannels());
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        before.path = after.path = path;
        const Frame second = drawAll(scene, {before, after}, options)[1];
        const Frame alone = drawAll(scene, {after}, options)[0];
        const Frame first = drawAll(scene, {before}, options)[0];
        expectSameChannels(second, alone);
        EXPECT_GT(differingPixels(first, second, Channel::lit), 0u) << "the change must show at all";
    }
}

TEST(FrameOf, BackgroundIsZeroAndItsIdMinusOne) {
    for (const char* name : {"builtin:spheres?lights=4", "builtin:empty", "builtin:background"}) {
        for (const Frame& frame : bothPaths(loadScene(name), smallImage(GBufferEncoding::standard))) {
            const Image& ids = frame.channels.at(Channel::material_id);
            std::size_t background = 0;
            for (std::size_t i = 0; i < ids.pixels(); ++i) {
                if (ids.data[i] != -1.0f) continue;
                ++background;
                for (const auto& [mode, image] : frame.channels)
                    for (int c = 0; c < image.components && mode != Channel::material_id; ++c)
                        ASSERT_EQ(image.pixel(i)[c], 0.0f)
                            << name << " " << frame.name << " " << debugMode(mode).name;
            }
            EXPECT_GT(background, 0u) << name;
        }
    }
}

// The covered fraction of the image, known by ray casting for this camera: 31.2 % is sky. The pixel grid
// accounts for 0.1 %.
TEST(FrameOf, SpheresCoverWhatRayCastingSays) {
    Settings settings = smallImage(GBufferEncoding::standard);
    settings.size = {1280, 720};
    const auto frames = bothPaths(loadScene("builtin:spheres?lights=16"), settings);
    EXPECT_NEAR(static_cast<double>(coveredPixels(frames[0])) / (1280 * 720), 1 - 0.312, 1e-3);
    EXPECT_EQ(frames[0].counters.lights, 17u) << "the sun counts too";
}

TEST(FrameOf, EveryTimeIsKeptInOrder) {
    RenderOptions options;
    options.channels = {Channel::lit};
    options.runs = 3;
    Settings settings = smallImage(GBufferEncoding::standard);
    settings.prepass = Switch::on;
    const Frame frame = drawAll(loadScene("builtin:triangle"), {settings}, options)[0];
    EXPECT_EQ(frame.time.runs, 3);
    EXPECT_LE(frame.time.min, frame.time.median);
    EXPECT_LE(frame.time.median, frame.time.max);
    EXPECT_GT(frame.time.min, 0);
    std::vector<std::string> names;
    for (const PassTime& pass : frame.passes) names.push_back(pass.name);
    EXPECT_EQ(names, (std::vector<std::string>{"clusters", "depth pre-pass", "assign lights", "shade"}));
}

}  // namespace
}  // namespace diptych::tests
