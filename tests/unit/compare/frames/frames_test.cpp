// SPDX-License-Identifier: MIT
// What a frame is asked for, notes of its picture, and options that leave channels out.
#include "compare/frames/device_precision.h"
#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"
#include "compare/frames/render_options.h"
#include "tests/support/nonfinite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace diptych {
namespace {

// Without the sun, all rotations of the environment share one view.
TEST(FrameRequest, AnEnvironmentsSunTurnsWithIt) {
    Settings settings;
    settings.env_rotation = 30;
    settings.ibl_intensity = 2;
    settings.env_sun = false;
    settings.scene_lights = false;
    ViewRequest request = viewRequest(settings);
    EXPECT_FALSE(request.environment_sun || request.scene_lights);
    EXPECT_EQ(request.environment_rotation, 0);
    EXPECT_EQ(request.environment_factor, 1);
    settings.env_sun = settings.scene_lights = true;
    request = viewRequest(settings);
    EXPECT_TRUE(request.environment_sun && request.scene_lights);
    EXPECT_EQ(request.environment_rotation, 30);
    EXPECT_EQ(request.environment_factor, 2);
}

TEST(FrameRequest, AnEnvironmentsSunIsNoted) {
    SceneView view;
    Light sun;
    sun.direction = {0, -1, 0};
    sun.color = {1, 1, 1};
    sun.intensity = 4;
    view.lights = {Light(), sun};
    EnvironmentSun extracted;
    extracted.found = true;
    extracted.fraction = 0.5;
    extracted.why = "no spot is bright enough";
    Settings settings;
    settings.ibl_intensity = 1;
    const auto noteOf = [&] {
        view.sun = std::make_shared<EnvironmentSun>(extracted);
        const Frame frame = describedFrame(Scene(), view, settings);
        return frame.notes.empty() ? "" : frame.notes.back();
    };
    EXPECT_EQ(noteOf(), "environment: its sun is a light " + describe(sun, 0.5));
    extracted.found = false;
    EXPECT_EQ(noteOf(), "environment: --env-sun on: no spot is bright enough");
    settings.ibl_intensity = 0;
    EXPECT_EQ(noteOf(), "") << "an environment without light";
    view.sun.reset();
    settings.ibl_intensity = 1;
    EXPECT_TRUE(describedFrame(Scene(), view, settings).notes.empty());
}

// Haze is before the background, too, unless its density is 0.
TEST(FrameRequest, ABackgroundIsThatWithoutHaze) {
    Scene scene;
    scene.background = {0.25f, 0.5f, 0.75f};
    for (const bool haze : {false, true})
        for (const float density : {0.0f, 0.1f}) {
            Settings settings;
            settings.haze = haze;
            settings.haze_density = density;
            const Frame frame = describedFrame(scene, SceneView(), settings);
            EXPECT_EQ(frame.background[2], haze && density > 0 ? 0 : 0.75f) << haze << density;
            EXPECT_EQ(frame.camera.choice, "");
        }
    SceneView wide;
    wide.default_view = "from above";
    wide.view.width = 160;
    wide.view.height = 90;
    wide.view.wider_frame = 2.3512;
    const Frame frame = describedFrame(scene, wide, Settings());
    EXPECT_EQ(frame.camera.choice, "from above");
    EXPECT_EQ(frame.notes,
              (std::vector<std::string>{
                  "the scene has no camera: viewed from above; --camera chooses another view",
                  "the camera's aspect ratio is 2.35:1, the picture's 1.78:1: more is visible above "
                  "and below, and nothing is cropped"}));
}

// The largest finite values: of fp16 65504, of 11 bits 65024 and of 10 bits 64512.
TEST(FrameNotes, EachComponentHasItsLargestValue) {
    const auto noted = [](int component, float value, LitFormat format) {
        Image image(2, 1, 3, 1.0f);
        image.at(1, 0, component) = value;
        const std::optional<std::string> text = overflowText(image, format);
        if (text) {
            EXPECT_EQ(*text, "lit: clamped to the range of " + std::string(nameOf(format)) +
                                 " at 1 pixel; use --lit-format fp32");
        }
        return text.has_value();
    };
    const float largest[] = {65024, 65024, 64512};
    for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(noted(c, 65504, LitFormat::fp16)) << c;
        EXPECT_FALSE(noted(c, std::nextafter(65504.0f, 0.0f), LitFormat::fp16)) << c;
        EXPECT_TRUE(noted(c, largest[c], LitFormat::b10g11r11)) << c;
        EXPECT_FALSE(noted(c, std::nextafter(largest[c], 0.0f), LitFormat::b10g11r11)) << c;
        EXPECT_FALSE(noted(c, inf, LitFormat::fp32)) << c;
    }
}

TEST(FrameNotes, WhatWasReplacedIsSaidByChannel) {
    Frame frame;
    EXPECT_TRUE(nonfiniteText(frame).empty());
    frame.settings.size = {10, 4};
    frame.repaired[Channel::lit] = {24, 25, 31};
    frame.repaired[Channel::normals] = {9};
    const std::string rest = ": replaced by 0 or the largest number, magenta in pictures";
    std::vector<std::string> expected;
    for (const auto& [channel, pixels] : frame.repaired)
        expected.push_back(channel == Channel::lit
                               ? "lit was NaN or infinite at 3 pixels, the first at 4,2" + rest
                               : "normals was NaN or infinite at 1 pixel, the first at 9,0" + rest);
    EXPECT_EQ(nonfiniteText(frame), expected);
    // Every value of a pixel; the sign of infinity is kept.
    Image image(2, 1, 4, 1.0f);
    image.data = {1, 2, 3, -inf, nan, -nan, inf, 4};
    EXPECT_EQ(replaceNonfinite(image), (std::vector<std::uint32_t>{0, 1}));
    constexpr float most = std::numeric_limits<float>::max();
    EXPECT_EQ(image.data, (PixelData{1, 2, 3, -most, 0, 0, most, 4}));
    recordNonfinite(frame, Channel::lit, {24, 40});
    EXPECT_EQ(frame.repaired[Channel::lit], (std::vector<std::uint32_t>{24, 25, 31, 40}));
}

// ---- Options ----

// A channel of a layer is left out where the scene has no such layer, unless somebody named it.
TEST(FrameOptions, ChannelsOfAbsentLayersAreLeftOut) {
    RenderOptions options;
    options.channels = {Channel::lit, Channel::clearcoat, Channel::sheen_color};
    const auto kept = [&](gpu::uint layers) { return withoutAbsentLayers(options, layers).channels; };
    using Channels = std::vector<Channel>;
    EXPECT_EQ(kept(0), Channels{Channel::lit});
    EXPECT_EQ(kept(gpu::LAYER_CLEARCOAT), (Channels{Channel::lit, Channel::clearcoat}));
    EXPECT_EQ(kept(gpu::LAYER_SHEEN), (Channels{Channel::lit, Channel::sheen_color}));
    options.requested = {Channel::sheen_color};
    EXPECT_EQ(kept(0), (Channels{Channel::lit, Channel::sheen_color}));
    EXPECT_FALSE(isOmitted(options, 0, Channel::sheen_color));
    EXPECT_TRUE(isOmitted(options, 0, Channel::clearcoat));
    options.named = false;
    EXPECT_EQ(kept(0), Channels{Channel::lit}) << "all that there are";
}

TEST(FrameOptions, TheUsualOnesAreThese) {
    const RenderOptions usual;
    EXPECT_TRUE(usual.channels.empty() && usual.requested.empty() && usual.every_sample.empty());
    EXPECT_TRUE(usual.named && usual.shadow_edges && usual.recheck);
    EXPECT_FALSE(usual.through_gbuffer || usual.environment_errors || usual.decoded);
    EXPECT_EQ(usual.runs, 5);
    EXPECT_EQ(usual.twice, Twice::none);
    // The least that Vulkan allows.
    const DevicePrecision least;
    EXPECT_EQ(least.sub_pixel_bits, 4u);
    EXPECT_EQ(least.sub_texel_bits, 4u);
    EXPECT_EQ(least.mipmap_bits, 4u);
    EXPECT_FALSE(least.texels);
}

// Channels of a surface come in the contract's order: lighting of channels binds them by it.
TEST(FrameOptions, ASurfaceHasItsChannelsInOrder) {
    const std::span<const Channel> channels = surfaceChannels();
    ASSERT_EQ(channels.size(), 23u);
    EXPECT_EQ(channels[0], Channel::albedo);
    EXPECT_EQ(channels[8], Channel::position);
    EXPECT_EQ(channels[13], Channel::clearcoat_normal);
    EXPECT_EQ(channels[22], Channel::diffuse_transmission_color);
}

}  // namespace
}  // namespace diptych
