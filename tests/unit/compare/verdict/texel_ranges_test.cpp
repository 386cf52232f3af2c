// SPDX-License-Identifier: MIT
// Ranges of what textures may show at a pixel, for the tolerance of another device.
#include "compare/verdict/texel_ranges.h"
#include "compare/verdict/neighbours.h"
#include "compare/verdict/surface_pixels.h"
#include "shared/contract/debug_mode.h"
#include "shared/material/texture_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

namespace diptych {
namespace {

constexpr int texel_side = 32;  // pixels

// A square of a material with a base colour texture of 64 x 64 texels.
struct TexturedPlane {
    Scene scene;
    Frame frame;

    explicit TexturedPlane(double texels_a_pixel, const std::function<int(int, int)>& code) {
        TextureImage image{"image", 64, 64, {}};
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const auto value = static_cast<std::uint8_t>(code(x, y));
                image.rgba.insert(image.rgba.end(), {value, value, value, 255});
            }
        scene.images.push_back(std::move(image));
        scene.textures.push_back({0, {}});
        scene.materials.emplace_back().base_color_texture.texture = 0;
        frame.settings.size = {texel_side, texel_side};
        for (const Channel channel : {Channel::material_id, Channel::texcoords})
            frame.channels[channel] = Image(texel_side, texel_side, debugMode(channel).width);
        for (int y = 0; y < texel_side; ++y)
            for (int x = 0; x < texel_side; ++x) {
                Image& uv = frame.channels.at(Channel::texcoords);
                uv.at(x, y, 0) = static_cast<float>((x * texels_a_pixel + 0.3) / 64);
                uv.at(x, y, 1) = static_cast<float>((y * texels_a_pixel + 0.3) / 64);
            }
    }
    float range() const {
        return texelRanges(scene, frame, {}).at(Channel::albedo).at(texel_side / 2, texel_side / 2, 0);
    }
};

TEST(TexelRanges, AreNoneOfOneColour) {
    EXPECT_EQ(TexturedPlane(1, [](int, int) { return 100; }).range(), 0);
}

TEST(TexelRanges, AreThoseOfTheTexelsThatMayBeSeen) {
    const auto checker = [](int x, int y) { return (x + y) % 2 == 0 ? 255 : 0; };
    EXPECT_NEAR(TexturedPlane(1, checker).range(), 1, 1e-6);
    // Mip level 3 and above is grey.
    EXPECT_NEAR(TexturedPlane(16, checker).range(), 0, 1e-6);
    // A dark square far away has no influence.
    EXPECT_EQ(TexturedPlane(1, [](int x, int y) { return x < 4 && y < 4 ? 0 : 200; }).range(), 0);
}

// A checker of codes 255 and `low`, whose alpha is its own colour, in the slots that `set` gives it.
std::map<Channel, Image> layerRanges(int low, const std::function<void(Material&)>& set) {
    TexturedPlane plane(1, [=](int x, int y) { return (x + y) % 2 == 0 ? 255 : low; });
    std::vector<std::uint8_t>& rgba = plane.scene.images[0].rgba;
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgba[i + 3] = rgba[i];
    Material& m = plane.scene.materials[0];
    m.base_color_texture.texture = -1;
    m.sheen_color = {0.25f, 0.5f, 0};
    m.sheen_roughness = 0.75f;
    m.iridescence = 0.5f;
    m.iridescence_ior = 1.5f;
    m.iridescence_thickness_min = 300;
    m.iridescence_thickness_max = 100;
    set(m);
    return texelRanges(plane.scene, plane.frame, {});
}
double rangeIn(const std::map<Channel, Image>& ranges, Channel channel) {
    const auto found = ranges.find(channel);
    return found == ranges.end() ? 0 : double{found->second.at(texel_side / 2, texel_side / 2, 0)};
}

TEST(TexelRanges, OfASheenAreItsColorsAndItsAlphas) {
    const auto color = layerRanges(51, [](Material& m) { m.sheen_color_texture.texture = 0; });
    EXPECT_NEAR(rangeIn(color, Channel::sheen_color), 0.5 * (1 - exactSrgb(51)), 1e-6);
    EXPECT_EQ(rangeIn(color, Channel::sheen_roughness), 0) << "the sheen is there wherever";
    const auto roughness = layerRanges(51, [](Material& m) { m.sheen_roughness_texture.texture = 0; });
    EXPECT_NEAR(rangeIn(roughness, Channel::sheen_roughness), 0.75 * 0.8, 1e-6) << "alpha is linear";
    EXPECT_EQ(rangeIn(roughness, Channel::sheen_color), 0);
}

// Without colour there is no sheen, whose roughness is then 0.
TEST(TexelRanges, ABlackTexelTakesTheSheenAway) {
    const auto ranges = layerRanges(0, [](Material& m) { m.sheen_color_texture.texture = 0; });
    EXPECT_NEAR(rangeIn(ranges, Channel::sheen_color), 0.5, 1e-6);
    EXPECT_NEAR(rangeIn(ranges, Channel::sheen_roughness), 0.75, 1e-6);
}

// Alpha is the weight of diffuse transmission; without weight it has no colour.
TEST(TexelRanges, AWeightOfZeroTakesDiffuseTransmissionAway) {
    const auto weigh = [](Material& m) {
        m.diffuse_transmission = 0.75f;
        m.diffuse_transmission_color = {0.25f, 0.5f, 0};
        m.diffuse_transmission_texture.texture = 0;
    };
    const auto kept = layerRanges(51, weigh), gone = layerRanges(0, weigh);
    EXPECT_NEAR(rangeIn(kept, Channel::diffuse_transmission), 0.75 * 0.8, 1e-6);
    EXPECT_EQ(rangeIn(kept, Channel::diffuse_transmission_color), 0);
    EXPECT_NEAR(rangeIn(gone, Channel::diffuse_transmission), 0.75, 1e-6);
    EXPECT_NEAR(rangeIn(gone, Channel::diffuse_transmission_color), 0.5, 1e-6);
    const auto color = layerRanges(51, [](Material& m) {
        m.diffuse_transmission = 0.75f;
        m.diffuse_transmission_color = {0.25f, 0.5f, 0};
        m.diffuse_transmission_color_texture.texture = 0;
    });
    EXPECT_NEAR(rangeIn(color, Channel::diffuse_transmission_color), 0.5 * (1 - exactSrgb(51)), 1e-6);
    EXPECT_EQ(rangeIn(color, Channel::diffuse_transmission), 0);
}

TEST(TexelRanges, OfAThicknessArePartsOfItsRange) {
    const auto ranges = layerRanges(51, [](Material& m) { m.iridescence_thickness_texture.texture = 0; });
    EXPECT_NEAR(rangeIn(ranges, Channel::iridescence_thickness), 200 * 0.8, 1e-4)
        << "either end may be larger";
    EXPECT_EQ(rangeIn(ranges, Channel::iridescence), 0);
}

TEST(TexelRanges, AWeightOfZeroTakesTheFilmAway) {
    const auto weigh = [](Material& m) { m.iridescence_texture.texture = 0; };
    const auto kept = layerRanges(51, weigh), gone = layerRanges(0, weigh);
    EXPECT_NEAR(rangeIn(kept, Channel::iridescence), 0.5 * 0.8, 1e-6);
    EXPECT_EQ(rangeIn(kept, Channel::iridescence_ior), 0);
    EXPECT_EQ(rangeIn(kept, Channel::iridescence_thickness), 0);
    EXPECT_NEAR(rangeIn(gone, Channel::iridescence), 0.5, 1e-6);
    EXPECT_NEAR(rangeIn(gone, Channel::iridescence_ior), 1.5, 1e-6);
    EXPECT_NEAR(rangeIn(gone, Channel::iridescence_thickness), 300, 1e-4);
}

// F0 darkens the base, and alpha is glossiness.
TEST(TexelRanges, OfSpecularGlossinessReachAlbedoAndRoughness) {
    TexturedPlane plane(1, [](int x, int y) { return (x + y) % 2 == 0 ? 255 : 0; });
    std::vector<std::uint8_t>& rgba = plane.scene.images[0].rgba;
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgba[i + 3] = rgba[i];
    Material& m = plane.scene.materials[0];
    m.base_color_texture.texture = -1;
    m.specular_color_texture.texture = 0;
    m.specular_glossiness = true;
    m.base_color = {0.5f, 0.25f, 0.125f, 1};
    m.specular_color = {0.25f, 0.5f, 0};
    m.roughness = 0.25f;
    const std::map<Channel, Image> ranges = texelRanges(plane.scene, plane.frame, {});
    for (const auto& [channel, range] :
         {std::pair{Channel::dielectric_f0, 0.5}, {Channel::albedo, 0.25}, {Channel::roughness, 0.75}})
        EXPECT_NEAR(ranges.at(channel).at(texel_side / 2, texel_side / 2, 0), range, 1e-6)
            << debugMode(channel).name;
}

// Directions have components 2 t - 1: degrees for three of a normal, or two of a line.
TEST(TexelRanges, OfDirectionsAreAngles) {
    const double three = 2 * std::sqrt(3.0) * degreesPerRadian * 0.8,
                 two = 2 * std::sqrt(2.0) * degreesPerRadian * 0.8;
    for (const float anisotropy : {0.0f, 0.5f}) {
        const auto bumps = layerRanges(51, [=](Material& m) {
            m.normal_texture.texture = 0;
            m.anisotropy = anisotropy;
        });
        EXPECT_NEAR(rangeIn(bumps, Channel::normals), three, 1e-4);
        EXPECT_NEAR(rangeIn(bumps, Channel::anisotropy_direction), anisotropy > 0 ? three : 0, 1e-4)
            << "perpendicular to the normal";
    }
    const auto steep = layerRanges(51, [](Material& m) {
        m.normal_texture.texture = 0;
        m.normal_scale = -2;
    });
    EXPECT_NEAR(rangeIn(steep, Channel::normals), 2 * three, 1e-4);
    const auto brushed = layerRanges(51, [](Material& m) {
        m.anisotropy = 0.5f;
        m.anisotropy_texture.texture = 0;
    });
    EXPECT_NEAR(rangeIn(brushed, Channel::anisotropy), 0.5 * 0.8, 1e-6);
    EXPECT_NEAR(rangeIn(brushed, Channel::anisotropy_direction), two, 1e-4);
    const auto metal = layerRanges(51, [](Material& m) {
        m.metallic = 0.5f;
        m.roughness = 0.25f;
        m.metallic_roughness_texture.texture = 0;
    });
    EXPECT_NEAR(rangeIn(metal, Channel::metallic), 0.5 * 0.8, 1e-6);
    EXPECT_NEAR(rangeIn(metal, Channel::roughness), 0.25 * 0.8, 1e-6);
}

// Pixel 16,16 shows texel 16,16; an offset of a quarter of the texture is one of 16 texels.
TEST(TexelRanges, TexelsAreSeenWhereTheSlotPutsThem) {
    for (const int x : {16, 32})
        for (const int y : {16, 32}) {
            TexturedPlane plane(1, [=](int u, int v) { return u == x && v == y ? 0 : 255; });
            TextureSlot& slot = plane.scene.materials[0].base_color_texture;
            for (const int u : {0, 1})
                for (const int v : {0, 1}) {
                    slot.u.z = 0.25 * u;
                    slot.v.z = 0.25 * v;
                    EXPECT_EQ(plane.range() > 0, x == 16 + 16 * u && y == 16 + 16 * v)
                        << x << " " << y << u << v;
                }
        }
}

TEST(TexelRanges, OfMagnifiedTexturesAreTheirWeightsSteps) {
    const auto checker = [](int x, int y) { return (x + y) % 2 == 0 ? 255 : 0; };
    // Vulkan's minimum precision for both devices: 4 subpixel bits and 4 mipmap bits.
    const double texels = 1.0 / 32, steps = 2 * (2.0 / 16 + 2.0 / 16 * texels);
    EXPECT_NEAR(TexturedPlane(texels, checker).range(), steps, 1e-6);
}

}  // namespace
}  // namespace diptych
