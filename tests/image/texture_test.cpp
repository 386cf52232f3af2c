// SPDX-License-Identifier: MIT
// Texels in pixels: 16-bit images exact to a single step, filters and wrap modes.
#include "shared/material/textures.h"
#include "tests/image/square.h"
#include "tests/support/srgb.h"

#include <limits>
#include <set>

namespace diptych::tests {
namespace {

// Two texels side by side; the right one is one 16-bit step above the left one in every component.
Scene deepSquare(std::uint16_t code) {
    Scene scene = square();
    TextureImage& image = scene.images[0];
    const auto next = static_cast<std::uint16_t>(code + 1);
    image = {"deep", 2, 1, {}, {code, code, code, code, next, next, next, next}};
    return scene;
}

// A linear slot: code / 65535, and one step more. R16G16B16A16_UNORM is exact to float rounding.
TEST(Textures, SixteenLinearBitsReachThePixel) {
    for (const int code : {0, 1, 1000, 32767, 65534}) {
        Scene scene = deepSquare(static_cast<std::uint16_t>(code));
        scene.materials[0].metallic_roughness_texture.texture = 0;
        for (const Frame& frame : draw(scene))
            for (const int x : {0, 3}) {
                const double expected = (code + (x == 3)) / 65535.0;
                EXPECT_NEAR(colorAt(frame, roughness, x, 0).x, expected, 1e-7) << frame.name << code;
                EXPECT_NEAR(colorAt(frame, metallic, x, 0).x, expected, 1e-7) << frame.name << code;
            }
    }
}

// A colour slot: the sRGB curve of code / 65535. A dark step is 1.2e-6; 8 bits would give 3.0e-4, and 16
// linear bits 1.5e-5.
TEST(Textures, SixteenBitsOfSrgbReachThePixel) {
    for (const int code : {0, 1, 2650, 32896, 65534}) {
        Scene scene = deepSquare(static_cast<std::uint16_t>(code));
        scene.materials[0].base_color_texture.texture = scene.materials[0].emissive_texture.texture = 0;
        scene.materials[0].emissive = {1, 1, 1};
        for (const Frame& frame : draw(scene))
            for (const int x : {0, 3}) {
                const auto expected = static_cast<float>(decodedSrgb((code + (x == 3)) / 65535.0));
                // Float rounding of the value.
                expectColor(colorAt(frame, albedo, x, 0), glm::vec3(expected), 1e-7f, frame.name);
                expectColor(colorAt(frame, emission, x, 0), glm::vec3(expected), 1e-7f, frame.name);
            }
    }
}

// Between the texels' centres: the weighted mean of the linear values, at half a 16-bit step. The device's
// weights have at least 8 bits (subTexelPrecisionBits).
TEST(Textures, SixteenBitsAreFilteredInLinearLight) {
    Scene scene = deepSquare(0);
    scene.images[0].rgba16 = {1000, 1000, 1000, 65535, 3000, 3000, 3000, 65535};
    scene.textures[0].sampler = {Wrap::clamp_to_edge, Wrap::clamp_to_edge, true, true, false, false};
    scene.materials[0].base_color_texture.texture = scene.materials[0].metallic_roughness_texture.texture = 0;
    const double a = decodedSrgb(1000 / 65535.0), b = decodedSrgb(3000 / 65535.0);
    // 8 pixels over 2 texels: pixel 3 is 3/8 of the way from the left centre to the right one.
    for (const Frame& frame : draw(scene, 8)) {
        EXPECT_NEAR(colorAt(frame, albedo, 3, 4).x, a + (b - a) * 3 / 8, (b - a) / 256) << frame.name;
        EXPECT_NEAR(colorAt(frame, roughness, 3, 4).x, (1000 + 2000 * 3 / 8.0) / 65535, 2000 / 65535.0 / 256)
            << frame.name;
    }
}

// Formats are chosen by what the device can filter. Half floats, which every device can filter, add a note
// on lost bits.
TEST(Textures, FormatsGiveWayInOrder) {
    const auto with = [](std::set<VkFormat> filtered) {
        return [filtered](VkFormat format) { return filtered.contains(format); };
    };
    const auto format = [&](bool deep, bool srgb, std::set<VkFormat> filtered,
                            TexturePrecision precision = TexturePrecision::device) {
        const TextureFormat f = textureFormat(deep, srgb, precision, with(std::move(filtered)));
        return std::pair(f.format, f.exact);
    };
    constexpr VkFormat unorm = VK_FORMAT_R16G16B16A16_UNORM, floats = VK_FORMAT_R32G32B32A32_SFLOAT,
                       halves = VK_FORMAT_R16G16B16A16_SFLOAT;
    EXPECT_EQ(format(false, true, {}), std::pair(VK_FORMAT_R8G8B8A8_SRGB, true));
    EXPECT_EQ(format(false, false, {}), std::pair(VK_FORMAT_R8G8B8A8_UNORM, true));
    EXPECT_EQ(format(true, false, {unorm, floats}), std::pair(unorm, true));
    EXPECT_EQ(format(true, false, {floats}), std::pair(floats, true));
    EXPECT_EQ(format(true, true, {unorm, floats}), std::pair(floats, true));
    EXPECT_EQ(format(true, true, {unorm}), std::pair(halves, false));
    EXPECT_EQ(format(true, false, {}), std::pair(halves, false));
    constexpr TexturePrecision exact = TexturePrecision::exact;
    EXPECT_EQ(format(false, true, {unorm, floats}, exact), std::pair(halves, true));
    EXPECT_EQ(format(false, false, {unorm, floats}, exact), std::pair(unorm, true));
    EXPECT_EQ(format(false, false, {floats}, exact), std::pair(floats, true));
    EXPECT_EQ(format(false, false, {}, exact), std::pair(halves, false));
    EXPECT_EQ(format(true, true, {unorm, floats}, exact), std::pair(floats, true));
}

// All pairs of wrap modes: 4 x 4 pixels over uv -1 to 2 (scale 3, offset -1) of a 3 x 3 texture, nearest.
// Texels outside 0 to 1 are known by hand.
TEST(Textures, WrapsOfEveryPair) {
    Scene scene = square();
    // Texel (x, y) has green 60 y and blue 60 x, read through the linear roughness (G) and metallic (B)
    // slots.
    TextureImage image{"three", 3, 3, {}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            for (const int c : {0, 60 * y, 60 * x, 255}) image.rgba.push_back(static_cast<std::uint8_t>(c));
    scene.images[0] = image;
    scene.materials[0].metallic_roughness_texture = {0, 0, {3, 0, -1}, {0, 3, -1}};
    const auto texel = [](Wrap wrap, int i) {  // i from -3 to 5, of 0, 1, 2
        if (wrap == Wrap::clamp_to_edge) return std::clamp(i, 0, 2);
        const int period = ((i + 3) / 3) % 2, within = (i + 3) % 3;  // period 1 is the image itself
        return wrap == Wrap::mirrored_repeat && period == 0 ? 2 - within : within;
    };
    for (const Wrap s : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
        for (const Wrap t : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
            scene.textures[0].sampler.wrap_s = s;
            scene.textures[0].sampler.wrap_t = t;
            for (const Frame& frame : draw(scene, 9))
                for (int y = 0; y < 9; ++y)
                    for (int x = 0; x < 9; ++x) {
                        ASSERT_NEAR(colorAt(frame, metallic, x, y).x, texel(s, x - 3) * 60 / 255.0, float32)
                            << frame.name << static_cast<int>(s) << " at " << x;
                        ASSERT_NEAR(colorAt(frame, roughness, x, y).x, texel(t, y - 3) * 60 / 255.0, float32)
                            << frame.name << static_cast<int>(t) << " at " << y;
                    }
        }
}

// Magnified: nearest takes the texel, linear the mean of two. Minified by 4, with a texture whose texels
// alternate between 0 and 1 in columns of two (so level 1 does too): checks the selected level and the
// interpolation between levels.
TEST(Textures, FiltersOfEveryKind) {
    Scene scene = square();
    TextureImage image{"columns", 16, 16, {}};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < 4; ++c) image.rgba.push_back(x % 4 < 2 ? 0 : 255);
    scene.images[0] = image;
    Material& m = scene.materials[0];
    m.metallic_roughness_texture.texture = 0;
    Sampler& sampler = scene.textures[0].sampler;
    const auto at = [&](const Sampler& kind, double scale, int pixels, int x) {
        sampler = kind;
        m.metallic_roughness_texture.u = {scale, 0, 0};
        m.metallic_roughness_texture.v = {0, scale, 0};
        const std::vector<Frame> frames = draw(scene, pixels);
        const float value = colorAt(frames[0], roughness, x, 1).x;
        EXPECT_EQ(value, colorAt(frames[1], roughness, x, 1).x);
        return value;
    };
    constexpr Wrap r = Wrap::repeat;
    // A quarter of the texture over 8 pixels, two pixels a texel. Pixel 3 is in texel 1 (0), a quarter
    // from its right edge: linear takes a quarter of texel 2 (1).
    EXPECT_EQ(at({r, r, false, true, true, true}, 0.25, 8, 3), 0.0f);
    EXPECT_NEAR(at({r, r, true, false, false, false}, 0.25, 8, 3), 0.25f, 1.0f / 256);
    // Two texels a pixel: level 1, which alternates 0, 1. Without mip levels, level 0: nearest takes texel
    // 2x or 2x + 1, which are equal; linear their mean.
    for (const bool linear : {false, true}) {
        EXPECT_EQ(at({r, r, true, linear, false, false}, 1, 8, 0), 0.0f);
        EXPECT_EQ(at({r, r, true, linear, false, false}, 1, 8, 1), 1.0f);
        EXPECT_NEAR(at({r, r, true, linear, true, false}, 1, 8, 1), 1.0f, 1.0f / 256);
        EXPECT_NEAR(at({r, r, true, linear, true, true}, 1, 8, 1), 1.0f, 1.0f / 256);
    }
    // Four texels a pixel: level 2, uniformly grey. Without mip levels the pixel's centre is between
    // texels 1 and 2: nearest takes 2, linear the mean.
    const float grey2 = 128 / 255.0f;
    for (const bool linear : {false, true})
        for (const bool between : {false, true})
            EXPECT_NEAR(at({r, r, true, linear, true, between}, 1, 4, 1), grey2, 1.0f / 256)
                << linear << between;
    EXPECT_EQ(at({r, r, true, false, false, false}, 1, 4, 1), 1.0f);
    EXPECT_NEAR(at({r, r, true, true, false, false}, 1, 4, 1), 0.5f, 1.0f / 256);
    // Three texels a pixel, log2(3) = 1.585: the nearest level is 2 (grey), and the blend has 0.585 of it.
    // At pixel 1, u = 4.5 / 16, level 1's nearest texel is 2 (0).
    EXPECT_NEAR(at({r, r, true, false, true, false}, 0.75, 4, 1), grey2, 1.0f / 256);
    // Drivers approximate the logarithm; if linear in the mantissa it is off by up to 0.086.
    EXPECT_NEAR(at({r, r, true, false, true, true}, 0.75, 4, 1), 0.585f * grey2, 0.086f * grey2 + 0.004f);
}

// Coordinates far outside the texture still give finite values, the same in both paths.
TEST(Textures, EndlessCoordinatesGiveNumbers) {
    constexpr float max = std::numeric_limits<float>::max();
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge})
        for (const double scale : {1.0, 1e12})
            for (const double offset : {0.0, -1e12}) {
                Scene scene = square();
                scene.meshes[0].primitives[0].texcoords[0] = {{0, max}, {max, max}, {max, -max}, {0, -max}};
                scene.textures[0].sampler = {};
                scene.textures[0].sampler.wrap_s = scene.textures[0].sampler.wrap_t = wrap;
                Material& m = scene.materials[0];
                m.base_color_texture = m.normal_texture = {0, 0, {scale, -scale, offset}, {scale, scale, 0}};
                Light sun;
                sun.kind = LightKind::directional;
                scene.lights = {sun};
                const std::vector<Frame> frames = draw(scene, 8);
                expectSameChannels(frames[0], frames[1]);
                for (const Frame& frame : frames) {
                    EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << frame.name << scale << offset;
                    for (const Channel channel : {albedo, normals})
                        for (const float value : frame.channels.at(channel).data)
                            ASSERT_TRUE(value >= -1 && value <= 1) << frame.name << scale << offset;
                }
            }
}

}  // namespace
}  // namespace diptych::tests
