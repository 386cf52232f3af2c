// SPDX-License-Identifier: MIT
// One path on two devices: hand-made Frames that differ in one way, within the allowed precision or beyond
// it.
#include "compare/verdict/across_devices.h"
#include "compare/explain/device_contributions.h"
#include "compare/verdict/comparison.h"
#include "compare/verdict/device_bounds.h"
#include "compare/verdict/surface_grid.h"
#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace diptych {
namespace {

constexpr int across_side = 32;

// A tilted plane in front of a camera at the origin, material 0 on the left half, 1 on the right. All
// texels of its textures are equal. The two devices together have a step of 1/16 of a pixel.
class AcrossDevicesPair : public testing::Test {
protected:
    AcrossDevicesPair() {
        report_.frames.resize(2);
        for (Frame& frame : report_.frames) {
            frame.settings.path = Path::forward_plus;
            frame.settings.gbuffer = GBufferEncoding::full;
            frame.settings.size = {across_side, across_side};
            frame.camera.target[2] = -1;
            frame.camera.up[1] = 1;
            frame.camera.fov_degrees = 60;
            for (const Channel mode :
                 {Channel::material_id, Channel::depth, Channel::albedo, Channel::roughness, Channel::lit,
                  Channel::lit_diffuse, Channel::shadow_visibility})
                frame.requested.push_back(mode);
        }
        report_.frames[0].name = "here";
        report_.frames[1].name = "there";
        report_.device = {"a", "driver", "cpu"};
        for (const DebugMode& mode : debugModes())
            if (mode.supported_by != SupportedBy::deferred_only)
                for (Frame& frame : report_.frames)
                    frame.channels[mode.channel] = Image(across_side, across_side, mode.width, 0.5f);
        for (int y = 0; y < across_side; ++y)
            for (int x = 0; x < across_side; ++x) place(x, y);
        for (std::size_t device = 0; device < 2; ++device) {
            DevicePrecision& precision = across_.devices[device];
            precision.name = device == 0 ? "a" : "b";
            precision.sub_pixel_bits = 5;
            precision.texels.emplace();
            for (std::size_t code = 0; code < 256; ++code) {
                precision.texels->linear[code] = static_cast<float>(code) / 255;
                precision.texels->srgb[code] = static_cast<float>(exactSrgb(code));
            }
        }
        across_.texels[Channel::albedo] = Image(across_side, across_side, 1);
        across_.texcoords = {&at(0, Channel::texcoords), &at(1, Channel::texcoords)};
        for (const Channel mode : litModes) across_.relit[mode] = at(1, mode);
    }

    // n.p = -5 with n = (0, 0.6, 0.8).
    void place(int x, int y) {
        const double half = std::tan(30 * 3.14159265358979 / 180), px = 2 * half / across_side;
        const double u = (x + 0.5) * px - half, v = half - (y + 0.5) * px;
        const double z = 5 / (0.8 - 0.6 * v);
        for (const std::size_t frame : {0, 1}) {
            const auto set = [&](Channel mode, std::initializer_list<double> values) {
                float* to = at(frame, mode).pixel(index(x, y));
                for (const double value : values) *to++ = static_cast<float>(value);
            };
            set(Channel::material_id, {x < across_side / 2 ? 0.0 : 1.0});
            set(Channel::depth, {z});
            set(Channel::position, {u * z, v * z, -z});
            set(Channel::geometric_normal, {0, 0.6, 0.8});
            set(Channel::normals, {0, 0.6, 0.8});
            set(Channel::clearcoat_normal, {0, 0.6, 0.8});
            set(Channel::anisotropy_direction, {1, 0, 0});
            set(Channel::texcoords, {u * z / 8, v * z / 8});
        }
    }

    static std::size_t index(int x, int y) {
        return static_cast<std::size_t>(y) * across_side + static_cast<std::size_t>(x);
    }
    Image& at(std::size_t frame, Channel mode) { return report_.frames[frame].channels.at(mode); }
    float* there(Channel mode, int x, int y) { return at(1, mode).pixel(index(x, y)); }
    void fill(std::size_t frame, Channel mode, double value) {
        std::ranges::fill(at(frame, mode).data, static_cast<float>(value));
    }

    Comparison compared() {
        CompareOptions options;
        options.across = &across_;
        return compareFrames(report_, 0, 1, needs_, options);
    }
    // Names of the failing channels, and failures of the pair.
    std::string faults() {
        const Comparison comparison = compared();
        std::string text;
        for (const std::string& failure : comparison.failures) text += failure + "; ";
        for (const ChannelDiff& channel : comparison.channels)
            if (channel.verdict == Verdict::fail) text += std::string(channel.mode->name) + " ";
        return text;
    }
    // Shows another surface, far behind, at a pixel of the second device.
    void showAnother(int x, int y, float material) {
        *there(Channel::material_id, x, y) = material;
        *there(Channel::depth, x, y) = 50;
        std::fill_n(there(Channel::texcoords, x, y), 2, 0.0f);
    }

    Report report_;
    AcrossDevices across_;
    Requirements needs_;
};

TEST_F(AcrossDevicesPair, TheSameImagesPassAndUseNothing) {
    for (Frame& frame : report_.frames) frame.requested.clear();
    EXPECT_EQ(faults(), "");
    for (const ChannelDiff& channel : compared().channels) {
        EXPECT_EQ(channel.stats.max, 0) << channel.mode->name;
        EXPECT_FALSE(channel.tolerance.because.empty()) << channel.mode->name;
    }
}

TEST_F(AcrossDevicesPair, APixelBesideAnEdgeMayShowWhatIsBeyondIt) {
    showAnother(across_side / 2, 7, 0);
    EXPECT_EQ(faults(), "");
    EXPECT_EQ(compared().coverage.count, std::size_t{across_side * across_side - 1});
}

TEST_F(AcrossDevicesPair, APixelAwayFromAnyEdgeMayNot) {
    showAnother(across_side / 4, 7, 1);
    // A single pixel makes its own edge in that image. In a patch the inner pixels have no edge beside
    // them.
    for (int y = 5; y < 10; ++y)
        for (int x = 5; x < 10; ++x) showAnother(x, y, 1);
    EXPECT_TRUE(faults().starts_with(
        "the other device shows another triangle at 9 pixels not beside an edge, the first at 6,6; "))
        << faults();
}

TEST_F(AcrossDevicesPair, AWholeEdgeAPixelElsewhereIsTooMuch) {
    for (int y = 0; y < across_side; ++y) showAnother(across_side / 2, y, 0);
    EXPECT_NE(faults().find("the other device shows another triangle at 32 pixels; tolerance:"),
              std::string::npos);
}

TEST_F(AcrossDevicesPair, ASurfaceOfTheSameDepthMayBeSeenWhereTheSceneHasOne) {
    for (int y = 5; y < 10; ++y)
        for (int x = 5; x < 10; ++x) *there(Channel::material_id, x, y) = 1;
    EXPECT_NE(faults().find("shows another triangle"), std::string::npos);
    across_.surface_at = [](int, const float* p, double, bool) { return p[1] > 0; };
    EXPECT_EQ(faults(), "");
    across_.surface_at = [](int material, const float*, double, bool) { return material == 0; };
    EXPECT_NE(faults().find("shows another triangle"), std::string::npos);
}

// A surface of the same depth is searched within both devices' steps of 1/16 of a pixel at the pixel's
// depth, plus the depth's rounding.
TEST_F(AcrossDevicesPair, ASurfaceOfTheSameDepthIsSoughtWithinAStepAndRounding) {
    constexpr int at_x = 5, at_y = 9;
    *there(Channel::material_id, at_x, at_y) = 1;
    std::vector<double> reaches;
    across_.surface_at = [&](int, const float*, double reach, bool) {
        reaches.push_back(reach);
        return true;
    };
    EXPECT_EQ(faults(), "");
    const double pixel = 2 * std::tan(30 * 3.14159265358979 / 180) / across_side,
                 depth = double{*at(0, Channel::depth).pixel(index(at_x, at_y))};
    ASSERT_EQ(reaches.size(), 2u) << "in both pictures";
    ASSERT_GT(relativeRounding(), 0);
    for (const double reach : reaches)
        EXPECT_NEAR(reach, depth * (pixel / 16 + relativeRounding()), 1e-3 * depth * relativeRounding());
}

TEST_F(AcrossDevicesPair, DepthMayMoveByTheStepsOfBothDevicesAndNotFurther) {
    const auto moveBy = [&](double pixels) {
        for (int y = 1; y < across_side; ++y)
            for (int x = 0; x < across_side; ++x) {
                const float here = *at(0, Channel::depth).pixel(index(x, y)),
                            above = *at(0, Channel::depth).pixel(index(x, y - 1));
                *there(Channel::depth, x, y) = here + static_cast<float>(pixels) * (above - here);
            }
    };
    moveBy(1.0 / 16);
    EXPECT_EQ(faults(), "");
    moveBy(0.2);
    EXPECT_NE(faults(), "");
}

// Two coplanar triangles whose texture coordinates jump by their change to the next pixel, as in a fan
// of polar coordinates. The second device moves the seam of five rows by a pixel.
TEST_F(AcrossDevicesPair, APixelMayCrossASmallSeamAndATriangleMayNotMoveByAQuarterPixelMore) {
    constexpr double change = 0.01, step = 1.0 / 16;
    const auto fillBy = [&](double pixels) {
        for (const std::size_t frame : {0, 1})
            for (int y = 0; y < across_side; ++y)
                for (int x = 0; x < across_side; ++x) {
                    const bool beyond = x >= (frame == 1 && y >= 3 && y <= 7 ? 9 : 8),
                               moved = frame == 1 && !beyond;
                    const double affine = change * (x + (beyond ? 1 : 0) + (moved ? pixels : 0));
                    float* uv = at(frame, Channel::texcoords).pixel(index(x, y));
                    uv[0] = static_cast<float>(affine * *at(frame, Channel::depth).pixel(index(x, y)));
                    uv[1] = 0;
                }
    };
    fillBy(0);
    EXPECT_EQ(faults(), "");
    fillBy(step);
    EXPECT_EQ(faults(), "");
    fillBy(step + 0.25);
    EXPECT_NE(faults().find(" not beside an edge"), std::string::npos) << faults();
}

TEST_F(AcrossDevicesPair, OneCodeOfATexelIsFound) {
    fill(0, Channel::albedo, exactSrgb(128));
    fill(1, Channel::albedo, exactSrgb(128));
    EXPECT_EQ(faults(), "");
    *there(Channel::albedo, 3, 3) = static_cast<float>(exactSrgb(129));
    EXPECT_EQ(faults(), "albedo ");
    // Unless other texels may be visible there.
    across_.texels.at(Channel::albedo).at(3, 3, 0) = 0.02f;
    EXPECT_EQ(faults(), "");
}

TEST_F(AcrossDevicesPair, AWrongCurveIsFound) {
    fill(0, Channel::albedo, exactSrgb(128));
    fill(1, Channel::albedo, std::pow(128.0 / 255, 2.2));
    EXPECT_EQ(faults(), "albedo ");
}

TEST_F(AcrossDevicesPair, WhatWasMeasuredOfDecodingIsGrantedAndNoMoreThanVulkanAllows) {
    fill(0, Channel::albedo, exactSrgb(128));
    fill(1, Channel::albedo, 1.01 * exactSrgb(128));
    EXPECT_EQ(faults(), "albedo ");
    for (float& value : across_.devices[1].texels->srgb) value *= 1.01f;
    EXPECT_EQ(faults(), "");
    // Half a code for each device is 1.7 % here.
    fill(1, Channel::albedo, 1.1 * exactSrgb(128));
    for (float& value : across_.devices[1].texels->srgb) value *= 1.1f;
    EXPECT_EQ(faults(), "albedo ");
}

// A sheen's colour is decoded as every sRGB texel.
TEST_F(AcrossDevicesPair, ASheensColorIsGrantedItsDecoding) {
    for (Frame& frame : report_.frames) frame.requested.push_back(Channel::sheen_color);
    across_.texels[Channel::sheen_color] = Image(across_side, across_side, 1);
    fill(0, Channel::sheen_color, exactSrgb(128));
    fill(1, Channel::sheen_color, 1.01 * exactSrgb(128));
    EXPECT_EQ(faults(), "sheen_color ");
    for (float& value : across_.devices[1].texels->srgb) value *= 1.01f;
    EXPECT_EQ(faults(), "");
}

// Filters round a texel; a thickness then differs by that part of the thicknesses among which texels choose.
TEST_F(AcrossDevicesPair, AThicknessIsGrantedTheRoundingOfItsRange) {
    for (Frame& frame : report_.frames) frame.requested.push_back(Channel::iridescence_thickness);
    across_.texels[Channel::iridescence_thickness] = Image(across_side, across_side, 1);
    for (DevicePrecision& device : across_.devices) device.texels->linear_filter.rounding = 0.5 / 255;
    fill(0, Channel::iridescence_thickness, 400);
    fill(1, Channel::iridescence_thickness, 400 + 0.9 * 300 / 255);
    EXPECT_EQ(faults(), "iridescence_thickness ");
    needs_.film_thickness_range = 300;
    EXPECT_EQ(faults(), "");
    needs_.film_thickness_range = 200;
    EXPECT_EQ(faults(), "iridescence_thickness ");
}

// The material's index does not show a pane: at its edge each device may show what is beside it.
TEST_F(AcrossDevicesPair, APaneMayEndAPixelBesideItsEdge) {
    const auto endAt = [&](std::size_t frame, int column) {
        for (int y = 0; y < across_side; ++y)
            for (int x = 0; x < across_side; ++x)
                at(frame, Channel::dispersion).at(x, y) = x < column ? 0.0f : 2.0f;
    };
    for (Frame& frame : report_.frames) frame.requested.push_back(Channel::dispersion);
    endAt(0, 20);
    endAt(1, 21);
    EXPECT_EQ(faults(), "");
    endAt(1, 22);
    EXPECT_EQ(faults(), "dispersion ") << "two pixels away";
    endAt(1, 20);
    *there(Channel::dispersion, 25, 5) = 2.1f;
    EXPECT_EQ(faults(), "dispersion ") << "inside the pane";
}

// A texture of thicknesses rounds in its unit.
TEST_F(AcrossDevicesPair, AVolumesThicknessIsGrantedTheRoundingOfItsRange) {
    for (Frame& frame : report_.frames) frame.requested.push_back(Channel::transmission_thickness);
    for (DevicePrecision& device : across_.devices) device.texels->linear_filter.rounding = 0.5 / 255;
    fill(0, Channel::transmission_thickness, 4);
    fill(1, Channel::transmission_thickness, 4 + 0.9 * 3 / 255);
    needs_.volume_thickness_range = 3;
    EXPECT_EQ(faults(), "transmission_thickness ") << "no texture";
    needs_.textures = 1;
    EXPECT_EQ(faults(), "");
    needs_.volume_thickness_range = 2;
    EXPECT_EQ(faults(), "transmission_thickness ");
}

// No texture scales a film's index, though the weight's texture may take the film away.
TEST_F(AcrossDevicesPair, AnIndexIsGrantedNoTexel) {
    for (Frame& frame : report_.frames) frame.requested.push_back(Channel::iridescence_ior);
    across_.texels[Channel::iridescence_ior] = Image(across_side, across_side, 1);
    for (DevicePrecision& device : across_.devices) device.texels->linear_filter.rounding = 0.5 / 255;
    fill(0, Channel::iridescence_ior, 1.3);
    fill(1, Channel::iridescence_ior, 1.301);
    EXPECT_EQ(faults(), "iridescence_ior ");
}

// Specular-glossiness: albedo is diffuse times 1 - F0. Half of what decoding changes at F0 0.9, where a code
// is 1 % of it, is far more than 1 % of an albedo of 0.05.
TEST_F(AcrossDevicesPair, F0DarkensTheAlbedoOfSpecularGlossiness) {
    for (const std::size_t frame : {0, 1}) fill(frame, Channel::dielectric_f0, 0.9);
    for (float& value : across_.devices[1].texels->srgb) value *= 1.01f;
    fill(0, Channel::albedo, 0.05);
    fill(1, Channel::albedo, 0.053);
    EXPECT_EQ(faults(), "albedo ");
    needs_.specular_glossiness = true;
    EXPECT_EQ(faults(), "");
    fill(1, Channel::albedo, 0.06);
    EXPECT_EQ(faults(), "albedo ");
}

TEST_F(AcrossDevicesPair, LightIsHeldToTheOtherDevicesLightingOfTheSameSurfaces) {
    // If surfaces differ within their tolerance, light may differ, too.
    fill(1, Channel::lit, 0.6);
    EXPECT_EQ(faults(), "lit ");
    across_.relit[Channel::lit] = at(1, Channel::lit);
    EXPECT_EQ(faults(), "");
    fill(1, Channel::lit, 0.6 * 1.0001);
    EXPECT_EQ(faults(), "");
    // One device misses a light.
    fill(1, Channel::lit_diffuse, 0.4);
    EXPECT_EQ(faults(), "lit_diffuse ");
}

// Integrals over area lights cancel, so a pixel far darker than the image may differ more. The components
// of lit get the same tolerance as lit.
TEST_F(AcrossDevicesPair, AreaLightsGrantTheDarkMoreAndNothingElseDoes) {
    const auto darken = [](Image& image, float value) { std::fill_n(image.pixel(index(20, 12)), 3, value); };
    for (const Channel mode : {Channel::lit, Channel::lit_diffuse}) {
        for (const std::size_t frame : {0, 1}) {
            fill(frame, mode, mode == Channel::lit ? 0.5 : 0.1);
            darken(at(frame, mode), 1e-3f);
        }
        Image& relit = across_.relit[mode];
        relit = at(1, mode);
        darken(relit, 1.009e-3f);
    }
    EXPECT_EQ(faults(), "lit lit_diffuse ");
    needs_.light_counts.back() = 1;
    EXPECT_EQ(faults(), "");
    darken(across_.relit[Channel::lit_diffuse], 1.02e-3f);
    EXPECT_EQ(faults(), "lit_diffuse ");
}

TEST_F(AcrossDevicesPair, ShadowsMayDifferBesideTheirEdgesAlone) {
    for (const std::size_t frame : {0, 1})
        for (int y = 0; y < across_side; ++y)
            for (int x = 0; x < across_side; ++x)
                *at(frame, Channel::shadow_visibility).pixel(index(x, y)) = y < 8 ? 0.0f : 1.0f;
    EXPECT_EQ(faults(), "");
    *there(Channel::shadow_visibility, 4, 8) = 0.75f;
    *there(Channel::lit, 4, 8) = 0.1f;
    EXPECT_EQ(faults(), "");
    for (int x = 10; x < 20; ++x)
        for (int y = 20; y < 24; ++y) *there(Channel::shadow_visibility, x, y) = 0;
    EXPECT_NE(faults().find(" not beside a shadow boundary"), std::string::npos);
}

// The other device's position is lit by one percent of the sun in this device's shadow map. Neither image
// shows that shadow boundary.
TEST_F(AcrossDevicesPair, AShadowMayEndBetweenBothPositionsOfAPixel) {
    Image& lit = across_.relit[Channel::lit];
    lit.at(7, 9, 0) *= 1.02f;
    EXPECT_EQ(faults(), "lit ");
    Image& visible = across_.relit[Channel::shadow_visibility];
    visible = at(1, Channel::shadow_visibility);
    EXPECT_EQ(faults(), "lit ");
    visible.at(7, 9) += 0.01f;
    EXPECT_EQ(faults(), "");
    for (int x = 15; x < 20; ++x)
        for (int y = 20; y < 24; ++y) visible.at(x, y) += 0.01f;
    EXPECT_NE(faults().find(" not beside a shadow boundary"), std::string::npos);
}

// Each kind of bound states its reason, with the numbers of both devices.
TEST_F(AcrossDevicesPair, EachToleranceHasItsReason) {
    for (Frame& frame : report_.frames) frame.requested.clear();
    across_.devices[0].sub_texel_bits = 6;
    across_.devices[1].sub_texel_bits = 8;
    across_.devices[1].sub_pixel_bits = 8;
    for (DevicePrecision& device : across_.devices) device.texels->linear_filter.rounding = 0.25 / 255;
    for (float& value : across_.devices[1].texels->srgb) value *= 1.015f;
    across_.texels[Channel::roughness] = Image(across_side, across_side, 1);
    const auto expectReasons = [&](const std::map<Channel, std::string>& reasons) {
        const Comparison comparison = compared();
        for (const auto& [mode, reason] : reasons) {
            const auto channel = std::ranges::find(comparison.channels, &debugMode(mode), &ChannelDiff::mode);
            ASSERT_NE(channel, comparison.channels.end()) << debugMode(mode).name;
            EXPECT_EQ(channel->tolerance.because, reason) << debugMode(mode).name;
        }
    };
    const std::string moved =
        "vertices snap to 1/32 and 1/256 of a pixel: the bound is that fraction of the change to the next "
        "pixel";
    const std::string rounded = moved + "; plus 9.5e-06 of the value for rounding";
    const std::string filtered =
        moved +
        "; filter weights have 6 and 8 bits; Vulkan does not fix the level of detail, so each device may "
        "return any mean of the texels in reach; ";
    const std::string index = "an index; where it changes, a neighbour's value is allowed",
                      shadow =
                          "float32 weights, 1e-4 each; at a shadow boundary, texels of the map may show "
                          "another triangle",
                      part = "a part of lit, which is compared",
                      list =
                          "each device uses the cell size that is cheapest on it; lights missing from a "
                          "list show in lit",
                      pane =
                          "surfaces with transmission, drawn over others: no more than neighbouring "
                          "pixels differ",
                      light =
                          "a shades the surfaces that b rendered, both in float32: 1e-4 each before "
                          "blending; after blending, no more than neighbouring pixels differ";
    expectReasons({{Channel::material_id, "an index is stored exactly"},
                   {Channel::cascade, index},
                   {Channel::lightmapped, index},
                   {Channel::geometric_normal,
                    "a triangle's normal, from positions rounded to 2^-24 of their distance, then packed"},
                   {Channel::depth, rounded},
                   {Channel::position, rounded},
                   {Channel::transmittance, rounded},
                   {Channel::metallic, moved},
                   {Channel::albedo, filtered + "their sRGB decoding differs by up to 1.5 %"},
                   {Channel::roughness, filtered + "filters round by up to 0.5 of an 8-bit step"},
                   {Channel::dispersion, pane},
                   {Channel::transmission, pane},
                   {Channel::lit, light},
                   {Channel::lit_specular, light},
                   {Channel::lit_environment, light},
                   {Channel::shadow_visibility, shadow},
                   {Channel::local_visibility, shadow},
                   {Channel::lit_clearcoat, part},
                   {Channel::lit_sheen, part},
                   {Channel::light_count, list},
                   {Channel::list_overflow, list}});
    // Textures on panes, area lights and packed G-buffers add theirs.
    needs_.textures = 1;
    needs_.light_counts.back() = 1;
    for (Frame& frame : report_.frames) {
        frame.settings.path = Path::deferred;
        frame.settings.gbuffer = GBufferEncoding::standard;
    }
    expectReasons(
        {{Channel::depth, rounded},
         {Channel::metallic, moved + "; plus the quantization bound of both G-buffers, 0.00392"},
         {Channel::roughness, filtered +
                                  "filters round by up to 0.5 of an 8-bit step; plus the quantization bound "
                                  "of both G-buffers, 0.000245"},
         {Channel::dispersion, pane},
         {Channel::transmission, pane + "; filters round by up to 0.5 of an 8-bit step"},
         {Channel::lit,
          "a shades the surfaces that b rendered, both in float32: 1e-4 each (relative to at least a tenth "
          "of the mean luminance: area-light integrals cancel) before blending; after blending, no more "
          "than neighbouring pixels differ"}});
}

// Each cause's map belongs to a source by its channel, and to edges where another surface is visible.
TEST_F(AcrossDevicesPair, AnExplanationIsDividedAmongSources) {
    showAnother(across_side / 2, 7, 0);
    across_.devices[1].sub_pixel_bits = 8;
    across_.devices[0].texels->linear_filter.rounding = 0.25 / 255;
    across_.devices[1].texels->linear_filter.rounding = 0.5 / 255;
    across_.devices[1].texels->srgb[7] *= 1.015f;
    std::fill_n(across_.texels.at(Channel::albedo).data.begin(), 512, 0.5f);
    Explanation explanation;
    double value = 1, all = 0;
    for (const char* cause : {"position", "geometric_normal", "roughness", "albedo", "shadow_visibility",
                              "local_visibility", "light_count", "--haze", "lit"}) {
        explanation.causes.emplace_back().name = cause;
        explanation.causes.back().map = Image(across_side, across_side, 1, static_cast<float>(value));
        all += value;
        value *= 2;
    }
    explanation.unexplained_map = Image(across_side, across_side, 1, 512.0f);
    all += 512;
    const auto divided = [&] {
        std::vector<std::tuple<std::string, double, std::string>> said;
        for (const DeviceContribution& each :
             deviceContributions(explanation, report_.frames[0], report_.frames[1], across_))
            said.emplace_back(each.name, each.contribution, each.description);
        return said;
    };
    constexpr double seen = 1023.0 / 1024, textured = 511.0 / 1024;
    auto expected = std::vector<std::tuple<std::string, double, std::string>>{
        {"rounding", (128 + 256 + 512) * seen, "shading of the same surfaces, blending and everything else"},
        {"light lists", 64 * seen, "different lights are evaluated"},
        {"shadow maps", (16 + 32) * seen, "visibility of shadow-casting lights"},
        {"vertices", (1 + 2 + 4) * seen + 8 * 0.5, "snapped to 1/32 and 1/256 of a pixel"},
        {"textures", 8 * textured,
         "decoding and filtering; measured: sRGB decoding differs by up to 1.5 %, filters round by up to "
         "0.25 "
         "and 0.5 of an 8-bit step"},
        {"edges", all / 1024, "another triangle at 1 pixel, another shadow beside its boundary at 0 pixels"}};
    EXPECT_EQ(divided(), expected);
    // Two surfaces of equal depth count as edges.
    across_.surface_at = [](int, const float*, double, bool) { return true; };
    *there(Channel::depth, across_side / 2, 7) = *at(0, Channel::depth).pixel(index(across_side / 2, 7));
    across_.devices[1].texels.reset();
    std::get<2>(expected[4]) = "decoding and filtering";
    EXPECT_EQ(divided(), expected);
}

// A pixel's angle: of the image's height in perspective, of its depth in an orthographic view.
TEST_F(AcrossDevicesPair, APixelsAngleFollowsTheCamera) {
    Frame& frame = report_.frames[0];
    *at(0, Channel::depth).pixel(index(3, 4)) = 6;
    EXPECT_NEAR(pixelsPerRadian(frame, index(3, 4)),
                across_side / (2 * std::tan(30 * 3.14159265358979 / 180)), 1e-9);
    const Coverage coverage = everyPixel(std::size_t{across_side} * across_side);
    const FramePair pair{frame, report_.frames[1], needs_, coverage};
    // Both devices' 28 roundings of 2^-24 of the distance, over the distance of neighbouring pixels.
    EXPECT_NEAR(FacetBound(pair)(index(3, 4)),
                2 * 28 * 0x1p-24 * pixelsPerRadian(frame, index(3, 4)) * degreesPerRadian, 1e-12);
    frame.camera.fov_degrees = 0;
    frame.camera.ymag = 2;
    EXPECT_EQ(pixelsPerRadian(frame, index(3, 4)), 6.0 * across_side / 4);
    frame.channels.erase(Channel::depth);
    EXPECT_EQ(pixelsPerRadian(frame, index(3, 4)), across_side);
}

// A pixel's neighbours of its material, surface and triangle.
TEST_F(AcrossDevicesPair, AGridKnowsWhichNeighboursAreOfOneSurface) {
    for (const std::size_t frame : {0, 1}) {
        at(frame, Channel::geometric_normal).at(20, 9, 1) =
            0.8f;  // a triangle of one pixel, turned by 16 degrees
        at(frame, Channel::geometric_normal).at(20, 9, 2) = 0.6f;
    }
    const Coverage coverage = everyPixel(std::size_t{across_side} * across_side);
    const FramePair pair{report_.frames[0], report_.frames[1], needs_,  coverage, true,
                         nullptr,           nullptr,           &across_};
    const SurfaceGrid grid(pair);
    const std::uint8_t all = grid.surface[index(5, 9)];
    EXPECT_EQ(all, grid.material[index(5, 9)]);
    EXPECT_EQ(grid.material[index(20, 9)], all);
    EXPECT_EQ(grid.narrow[index(5, 9)], 0);
    EXPECT_EQ(grid.narrow[index(20, 9)], 1);
    EXPECT_EQ(grid.steeper[index(5, 9)], 1) << "a plane is as steep as it looks";
    // The turned triangle's own slope over what its neighbours show; a pixel is z tan(30 degrees) / 16.
    const Image& depths = at(0, Channel::depth);
    const double z = double{depths.at(20, 9)}, pixel = z * std::tan(30 * 3.14159265358979 / 180) / 16;
    const float* const p = at(0, Channel::position).pixel(index(20, 9));
    const double facing = std::abs(0.8 * double{p[1]} + 0.6 * double{p[2]}) / z, along = 0.8 * pixel,
                 slope = along / (facing - along / 16 / z);
    double shown = 0;
    for (const auto& [x, y] : {std::pair{19, 9}, {21, 9}, {20, 8}, {20, 10}})
        shown = std::max(shown, std::abs(double{depths.at(x, y)} - z));
    EXPECT_NEAR(grid.steeper[index(20, 9)], slope / shown, 1e-4);
    EXPECT_NE(grid.material[index(across_side / 2, 9)], all) << "beside another material";
    EXPECT_EQ(grid.material[index(across_side / 2, 9)], grid.surface[index(across_side / 2, 9)]);
}

TEST_F(AcrossDevicesPair, ANumberAgainstNoneFails) {
    *there(Channel::roughness, 3, 3) = std::nanf("");
    EXPECT_NE(faults().find("roughness"), std::string::npos);
}

}  // namespace
}  // namespace diptych
