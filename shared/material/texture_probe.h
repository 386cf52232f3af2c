// SPDX-License-Identifier: MIT
// Measures how a device samples 8-bit textures: the decoded value of each code, and the error of linear
// filtering. Vulkan leaves both partly open, and lavapipe deviates. The same for the texels of
// TexturePrecision::exact, whose remaining error is that of format and filter.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device/device.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// The decoded value of each code.
using TexelDecode = std::array<float, 256>;

// Exact sRGB decoding of an 8-bit code, IEC 61966-2-1.
double exactSrgb(std::size_t code);

// One bilinear sample of a component: the range of its four decoded texels, and its error against the
// exact interpolation.
struct FilterSample {
    double range = 0, error = 0;
};

// Bound: every measured error is at most `rounding` + `weight` x range. `rounding` covers the arithmetic,
// `weight` the interpolation weights.
struct FilterBound {
    double rounding = 0, weight = 0;

    double of(double range) const { return rounding + weight * range; }
};

struct TextureSampling {
    TexelDecode linear{}, srgb{};  // alpha of an sRGB texel is linear
    FilterBound linear_filter, srgb_filter;

    const TexelDecode& decode(bool isSrgb) const { return isSrgb ? srgb : linear; }
    // Error of the device's value for an sRGB code.
    double srgbError(std::size_t code) const;
};

// Measures everything; takes some tenths of a second on a CPU device.
TextureSampling probeTextures(Device& device, TexturePrecision precision = TexturePrecision::device);
// The worst of red, green and blue for sRGB texels.
TexelDecode probeDecode(Device& device, bool srgb, TexturePrecision precision = TexturePrecision::device);
// RGBA of single-colour images (8-bit RGBA), as a linear filter returns them.
std::vector<glm::vec4> probeColors(Device& device, std::span<const std::array<std::uint8_t, 4>> colors,
                                   bool srgb, TexturePrecision precision);
// Samples a noise image of varying contrast at 65536 positions.
std::vector<FilterSample> probeFilter(Device& device, bool srgb, const TexelDecode& decode,
                                      std::uint32_t seed,
                                      TexturePrecision precision = TexturePrecision::device);

// The line above all samples that is lowest at their mean range. Throws std::invalid_argument without
// samples.
FilterBound boundOf(std::span<const FilterSample> samples);

// For users, as Device::probe(): both precisions, and Vulkan's limits.
std::vector<DeviceProperty> textureProperties(const Device& device, const TextureSampling& sampling,
                                              const TextureSampling& exact);

// Replaces every 8-bit texture of a colour slot by what the device decodes, as floats. A renderer that
// decodes exactly then sees the device's values.
Scene withDecodedColors(Scene scene, const TexelDecode& srgb);

}  // namespace diptych
