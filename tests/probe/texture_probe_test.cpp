// SPDX-License-Identifier: MIT
// 8-bit texture sampling as shared/material measures it on the device, compared with Vulkan's guarantees
// and with samples outside the measurement.
#include "shared/material/texture_probe.h"
#include "tests/probe/probe.h"
#include "tests/support/srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace diptych {
namespace {

const TextureSampling& sampling() {
    static const TextureSampling measured = probeTextures(probeDevice());
    return measured;
}

const TextureSampling& exactSampling() {
    static const TextureSampling measured = probeTextures(probeDevice(), TexturePrecision::exact);
    return measured;
}

// Number of sRGB codes whose decoded value would encode to a different code.
std::size_t ambiguousCodes(const TexelDecode& srgb) {
    std::size_t count = 0;
    for (std::size_t code = 0; code < 256; ++code) {
        const double encoded = encodedSrgb(double{srgb[code]});
        count += !(std::abs(encoded * 255 - static_cast<double>(code)) < 0.5);
    }
    return count;
}

// Vulkan 1.3, 3.10 "Fixed-Point Data Conversions": code / 255, to float precision.
TEST(TextureProbe, LinearCodesAreFractions) {
    for (std::size_t code = 0; code < 256; ++code) {
        const double exact = static_cast<double>(code) / 255;
        EXPECT_NEAR(double{sampling().linear[code]}, exact, exact * 0x1p-23) << code;
    }
    EXPECT_EQ(sampling().linear[0], 0.0f);
    EXPECT_EQ(sampling().linear[255], 1.0f);
}

// For sRGB, Vulkan guarantees only that eight bits survive.
TEST(TextureProbe, SrgbCodesStayApart) {
    const TexelDecode& srgb = sampling().srgb;
    EXPECT_EQ(ambiguousCodes(srgb), 0u);
    for (std::size_t code = 1; code < 256; ++code) EXPECT_GT(srgb[code], srgb[code - 1]) << code;
    EXPECT_EQ(srgb[0], 0.0f);
    EXPECT_NEAR(double{srgb[255]}, 1, 1e-6);
    TexelDecode linear = sampling().linear;
    EXPECT_GT(ambiguousCodes(linear), 200u) << "the negative control: not decoded at all";
    linear = srgb;
    linear[40] = srgb[41];
    EXPECT_EQ(ambiguousCodes(linear), 1u) << "the negative control: one code off by one";
    for (const DeviceProperty& property : textureProperties(probeDevice(), sampling(), exactSampling()))
        std::cout << property.what << ": " << (property.there ? "yes" : "no") << ", " << property.note
                  << "\n";
}

// The bound is valid at other positions of another image, and half of it is not: it is tight.
TEST(TextureProbe, FiltersAreBoundedAsTightlyAsTheyErr) {
    for (const bool srgb : {false, true}) {
        const FilterBound& bound = srgb ? sampling().srgb_filter : sampling().linear_filter;
        std::size_t beyond = 0, beyondHalf = 0;
        double largest = 0;
        const std::vector<FilterSample> samples =
            probeFilter(probeDevice(), srgb, sampling().decode(srgb), 77);
        for (const FilterSample& sample : samples) {
            // Measured at 262144 positions, the bound may miss the last few percent.
            beyond += sample.error > 1.05 * bound.of(sample.range) + 1e-7;
            beyondHalf += sample.error > 0.5 * bound.of(sample.range);
            largest = std::max(largest, sample.error);
        }
        EXPECT_EQ(beyond, 0u) << srgb;
        EXPECT_GT(beyondHalf, samples.size() / 1000) << srgb;
        // Weights of four bits would be off by 1/32; a filter that does not interpolate, by half a range.
        EXPECT_LT(bound.weight, 1.0 / 128) << srgb;
        EXPECT_LT(bound.rounding, 2.0 / 255) << srgb;
        std::cout << (srgb ? "sRGB" : "linear") << ": " << bound.rounding * 255 << " of a code, and "
                  << bound.weight << " of the range; at most " << largest << "\n";
    }
}

// Texels of --textures exact: linear codes are exact in 16 bits; for sRGB, half floats keep 11 bits at
// every code on every device. A filter that rounds to 8-bit texels would be off by half a code, one of 16
// bits by 1/257 of that. The weights are the device's, unchanged.
TEST(TextureProbe, ExactTexelsAreDecodedAndFilteredWithoutRounding) {
    const TextureSampling& exact = exactSampling();
    for (std::size_t code = 0; code < 256; ++code) {
        const double linear = static_cast<double>(code) / 255;
        EXPECT_NEAR(double{exact.linear[code]}, linear, linear * 0x1p-22) << code;
        EXPECT_NEAR(double{exact.srgb[code]}, exactSrgb(code), exactSrgb(code) * 0x1p-11 * 1.001) << code;
    }
    for (const FilterBound& bound : {exact.linear_filter, exact.srgb_filter}) {
        EXPECT_LT(bound.rounding * 255, 0.02);
        EXPECT_LT(bound.weight, 1.0 / 128);
    }
}

TEST(TextureProbe, ABoundIsTheLowestLineAboveItsSamples) {
    // All samples are at or below 0.1 + 0.5 range; three of them touch it.
    const std::vector<FilterSample> samples{{0, 0.1}, {0.2, 0.2}, {0.5, 0.3}, {1, 0.6}, {0.5, 0}};
    const FilterBound bound = boundOf(samples);
    EXPECT_NEAR(bound.rounding, 0.1, 1e-12);
    EXPECT_NEAR(bound.weight, 0.5, 1e-12);
    const FilterBound flat = boundOf(std::vector<FilterSample>{{0, 0.2}, {0.5, 0.2}, {1, 0.1}});
    EXPECT_EQ(flat.rounding, 0.2) << "a larger range permits no smaller error";
    EXPECT_EQ(flat.weight, 0);
    EXPECT_THROW(boundOf({}), std::invalid_argument);
}

// Images read by colour slots become the device's floats; other slots still read the original, even of the
// same image.
TEST(TextureProbe, ScenesWithDecodedColors) {
    Scene scene;
    scene.images = {{"one", 1, 1, {10, 100, 200, 51}}};
    scene.textures = {{0, {}}};
    scene.materials.resize(2);
    Material& m = scene.materials[0];
    m.base_color_texture.texture = m.occlusion_texture.texture = m.emissive_texture.texture = 0;
    m.emissive = {1, 1, 1};
    scene.materials[1].base_color_texture.texture = 0;
    TexelDecode srgb{};
    srgb[10] = 0.5f;
    srgb[200] = 3;
    const Scene decoded = withDecodedColors(scene, srgb);
    const Material& after = decoded.materials[0];
    EXPECT_EQ(after.occlusion_texture.texture, 0);
    EXPECT_EQ(decoded.images[0].rgba, scene.images[0].rgba);
    ASSERT_EQ(decoded.images.size(), 2u) << "one image for all colour slots";
    EXPECT_EQ(decoded.textures[static_cast<std::size_t>(after.base_color_texture.texture)].image, 1);
    EXPECT_EQ(after.emissive_texture.texture, after.base_color_texture.texture);
    EXPECT_EQ(decoded.materials[1].base_color_texture.texture, after.base_color_texture.texture);
    EXPECT_EQ(decoded.images[1].rgba32, (std::vector<float>{0.5f, 0, 3, 0.2f}));
}

}  // namespace
}  // namespace diptych
