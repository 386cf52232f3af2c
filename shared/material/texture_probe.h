// SPDX-License-Identifier: MIT
// What a device makes of texels of 8 bits, measured by drawing: how it decodes each code, and how far from
// the exact mixture a linear filter may be. Vulkan leaves room for both, and lavapipe uses it. The same of
// texels that TexturePrecision::exact makes of these codes: what is left is the format's and the filter's.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// The decoded value of each code.
using TexelDecode = std::array<float, 256>;

// sRGB decoding, IEC 61966-2-1, of a code of 8 bits.
double exactSrgb(std::size_t code);

// One bilinear sample of a component: the largest difference between the four decoded texels that it mixes,
// and how far it is from their exact mixture.
struct FilterSample {
    double range = 0, error = 0;
};

// The error of every sample measured is at most `rounding` + `weight` x range. `rounding` is that of the
// device's arithmetic, `weight` that of the texels' shares.
struct FilterBound {
    double rounding = 0, weight = 0;

    double of(double range) const { return rounding + weight * range; }
};

struct TextureSampling {
    TexelDecode linear{}, srgb{};  // alpha of an sRGB texel is linear
    FilterBound linear_filter, srgb_filter;

    const TexelDecode& decode(bool isSrgb) const { return isSrgb ? srgb : linear; }
    // By how much the device's value of an sRGB code is off.
    double srgbError(std::size_t code) const;
};

// All of it: some tenths of a second on a CPU device.
TextureSampling probeTextures(Device& device, TexturePrecision precision = TexturePrecision::device);
// Of the red, green and blue components of an sRGB texel the one that is furthest off.
TexelDecode probeDecode(Device& device, bool srgb, TexturePrecision precision = TexturePrecision::device);
// RGBA of images of one colour, RGBA of 8 bits, as a linear filter returns them.
std::vector<glm::vec4> probeColors(Device& device, std::span<const std::array<std::uint8_t, 4>> colors,
                                   bool srgb, TexturePrecision precision);
// Of a picture of noise whose contrast differs from place to place, at 65536 places.
std::vector<FilterSample> probeFilter(Device& device, bool srgb, const TexelDecode& decode,
                                      std::uint32_t seed,
                                      TexturePrecision precision = TexturePrecision::device);

// The line above all samples that is lowest at their mean range. Throws std::invalid_argument without
// samples.
FilterBound boundOf(std::span<const FilterSample> samples);

// For people, as Device::probe(): of both precisions, beside what Vulkan allows.
std::vector<DeviceFact> textureFacts(const Device& device, const TextureSampling& sampling,
                                     const TextureSampling& exact);

// The scene with every texture of 8 bits that a colour slot reads replaced by what the device decodes, as
// floats: a renderer that decodes exactly sees what the device sees.
Scene withDecodedColors(Scene scene, const TexelDecode& srgb);

}  // namespace diptych
