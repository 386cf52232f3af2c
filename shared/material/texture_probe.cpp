// SPDX-License-Identifier: MIT
#include "shared/material/texture_probe.h"

#include "shared/material/textures.h"
#include "shared/scene/model/material_slots.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <fmt/format.h>
#include <array>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

constexpr std::array probeTypes{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

Sampler probeSampler(bool linear) {
    Sampler sampler;
    sampler.magnify_linear = sampler.minify_linear = linear;
    sampler.mipmaps = sampler.mipmaps_linear = false;
    return sampler;
}

constexpr int probeWidth = 256;

// Samples the image at `places`, UV in rows of probeWidth, with wrap mode repeat; returns RGBA.
std::vector<float> sampled(Device& device, const TextureImage& content, bool srgb, TexturePrecision precision,
                           bool linear, std::span<const glm::vec2> places) {
    constexpr int width = probeWidth;
    const int height = static_cast<int>(places.size()) / width;
    TextureImage where{"places", width, height, {}};
    for (const glm::vec2& position : places)
        where.rgba32.insert(where.rgba32.end(), {position.x, position.y, 0.0f, 0.0f});
    Uploader uploader(device);
    const auto upload = [&](const TextureImage& image, bool colors) {
        const TextureFormat format = textureFormat(device, image, colors, precision);
        return uploadTexture(device, uploader, MipChain(image, colors, format.texels), format.format);
    };
    const GpuImage positionsImage = upload(where, true), contentImage = upload(content, srgb);
    uploader.flush();
    const OwnedSampler fetch = makeNearestSampler(device),
                       sampler = makeSampler(device, probeSampler(linear));
    const OwnedDescriptorSetLayout setLayout = makeSetLayout(device, probeTypes);
    DescriptorSets sets(device, setLayout, probeTypes, 1);
    sets.image(0, 0, positionsImage.view(), fetch, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    sets.image(0, 1, contentImage.view(), sampler, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);

    const OwnedPipelineLayout layout =
        makePipelineLayout(device, std::array<VkDescriptorSetLayout, 1>{setLayout});
    Pipelines pipelines(device, layout);
    PassList passes(device, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    const ImageRef target = passes.image("probe", VK_FORMAT_R32G32B32A32_SFLOAT);
    const Pipeline pipeline = pipelines.get({.vertex = Shader::full_screen_vert,
                                             .fragment = Shader::probe_texture_frag,
                                             .variant = {},
                                             .input = 0,
                                             .colors = {VK_FORMAT_R32G32B32A32_SFLOAT}});
    passes.draw("probe").color(target, Load::clear).record([&](VkCommandBuffer commands) {
        const VkDescriptorSet set = sets[0];
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, nullptr);
        vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
        vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
        vkCmdDraw(commands, 3, 1, 0, 0);
    });
    passes.run();
    return passes.readBack(std::array{PassList::ReadBack{target, 4}}).front();
}

// ---- filtering ---------------------------------------------------------------------------------------

constexpr int noiseSide = 64;

// Bands of eight rows whose contrast grows from one code to all.
TextureImage noise(std::uint32_t& state) {
    constexpr std::array contrasts{1u, 2u, 4u, 16u, 48u, 96u, 192u, 256u};
    const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
    TextureImage image{"noise", noiseSide, noiseSide, {}};
    for (std::uint32_t band = 0; band < contrasts.size(); ++band)
        for (int block = 0; block < noiseSide / 8; ++block) {
            // A block of 8 x 8 texels; `min` is its darkest code.
            const std::uint32_t min = random() % (257 - contrasts[band]);
            for (int i = 0; i < 8 * 8 * 4; ++i)
                image.rgba.push_back(static_cast<std::uint8_t>(min + random() % contrasts[band]));
        }
    // Converts blocks to rows.
    std::vector<std::uint8_t> rows(image.rgba.size());
    for (std::size_t y = 0; y < noiseSide; ++y)
        for (std::size_t x = 0; x < noiseSide; ++x)
            for (std::size_t c = 0; c < 4; ++c)
                rows[4 * (y * noiseSide + x) + c] =
                    image.rgba[4 * ((y / 8 * 8 + x / 8) * 64 + y % 8 * 8 + x % 8) + c];
    image.rgba = std::move(rows);
    return image;
}

struct Mixture {
    std::array<double, 4> texels;
    double x, y;  // weights of the right and of the lower two

    double exact() const {
        return (texels[0] * (1 - x) + texels[1] * x) * (1 - y) + (texels[2] * (1 - x) + texels[3] * x) * y;
    }
    double range() const {
        const auto [min, max] = std::ranges::minmax(texels);
        return max - min;
    }
};

}  // namespace

double exactSrgb(std::size_t code) {
    const double encoded = static_cast<double>(code) / 255;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double TextureSampling::srgbError(std::size_t code) const {
    return std::abs(double{srgb[code]} - exactSrgb(code));
}

TexelDecode probeDecode(Device& device, bool srgb, TexturePrecision precision) {
    TextureImage codes{"codes", 256, 1, {}};
    std::vector<glm::vec2> places;
    for (int code = 0; code < 256; ++code) {
        codes.rgba.insert(codes.rgba.end(), 4, static_cast<std::uint8_t>(code));
        places.emplace_back((static_cast<float>(code) + 0.5f) / 256, 0.5f);
    }
    const std::vector<float> rgba = sampled(device, codes, srgb, precision, false, places);
    TexelDecode decode{};
    for (std::size_t code = 0; code < 256; ++code) {
        const double exact = srgb ? exactSrgb(code) : static_cast<double>(code) / 255;
        decode[code] = *std::max_element(&rgba[4 * code], &rgba[4 * code + 3], [&](float a, float b) {
            return std::abs(double{a} - exact) < std::abs(double{b} - exact);
        });
    }
    return decode;
}

// Draws blocks of 2 x 2 equal texels and samples their centres.
std::vector<glm::vec4> probeColors(Device& device, std::span<const std::array<std::uint8_t, 4>> colors,
                                   bool srgb, TexturePrecision precision) {
    constexpr std::size_t columns = probeWidth;
    const std::size_t rows = (colors.size() + columns - 1) / columns;
    TextureImage blocks{"colours", static_cast<int>(2 * columns), static_cast<int>(2 * rows), {}};
    blocks.rgba.resize(4 * 2 * columns * 2 * rows);
    std::vector<glm::vec2> places;
    for (std::size_t i = 0; i < columns * rows; ++i) {
        const std::size_t x = i % columns, y = i / columns;
        const std::array<std::uint8_t, 4> color =
            i < colors.size() ? colors[i] : std::array<std::uint8_t, 4>{};
        for (const std::size_t row : {2 * y, 2 * y + 1})
            for (const std::size_t column : {2 * x, 2 * x + 1})
                std::ranges::copy(color, &blocks.rgba[4 * (row * 2 * columns + column)]);
        places.emplace_back((static_cast<float>(x) + 0.5f) / columns,
                            (static_cast<float>(y) + 0.5f) / static_cast<float>(rows));
    }
    const std::vector<float> rgba = sampled(device, blocks, srgb, precision, true, places);
    std::vector<glm::vec4> found;
    for (std::size_t i = 0; i < colors.size(); ++i)
        found.emplace_back(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], rgba[4 * i + 3]);
    return found;
}

std::vector<FilterSample> probeFilter(Device& device, bool srgb, const TexelDecode& decode,
                                      std::uint32_t seed, TexturePrecision precision) {
    constexpr int side = probeWidth;
    std::uint32_t state = seed;
    const TextureImage content = noise(state);
    std::vector<glm::vec2> places;
    for (int i = 0; i < side * side; ++i) {
        const auto random = [&] {
            state = state * 1664525u + 1013904223u;
            return static_cast<float>(state >> 8) * 0x1p-24f;
        };
        const float u = random();
        places.emplace_back(u, random());
    }
    const std::vector<float> got = sampled(device, content, srgb, precision, true, places);
    const auto texel = [&](int x, int y, std::size_t c) {
        const auto wrapped = [](int i) { return static_cast<std::size_t>((i + noiseSide) % noiseSide); };
        return double{decode[content.rgba[4 * (wrapped(y) * noiseSide + wrapped(x)) + c]]};
    };
    std::vector<FilterSample> samples;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec2 at = glm::dvec2(places[i]) * double{noiseSide} - 0.5, first = glm::floor(at);
        const int x = static_cast<int>(first.x), y = static_cast<int>(first.y);
        for (std::size_t c = 0; c < 3; ++c) {
            const Mixture mixture{
                {texel(x, y, c), texel(x + 1, y, c), texel(x, y + 1, c), texel(x + 1, y + 1, c)},
                at.x - first.x,
                at.y - first.y};
            samples.push_back({mixture.range(), std::abs(double{got[4 * i + c]} - mixture.exact())});
        }
    }
    return samples;
}

// The edge of the samples' upper convex hull above their mean range. Falling edges are skipped, because a
// larger range cannot allow a smaller error.
FilterBound boundOf(std::span<const FilterSample> samples) {
    if (samples.empty()) throw std::invalid_argument("a filter's bound of no samples");
    std::vector<FilterSample> sorted(samples.begin(), samples.end());
    std::ranges::sort(sorted, [](const FilterSample& a, const FilterSample& b) {
        return std::pair(a.range, a.error) < std::pair(b.range, b.error);
    });
    double mean = 0, max = 0;
    for (const FilterSample& s : sorted) {
        mean += s.range / static_cast<double>(sorted.size());
        max = std::max(max, s.error);
    }
    std::vector<FilterSample> hull{{0, 0}};
    const auto isBelow = [](const FilterSample& a, const FilterSample& b, const FilterSample& c) {
        return (b.error - a.error) * (c.range - a.range) <= (c.error - a.error) * (b.range - a.range);
    };
    for (const FilterSample& s : sorted) {
        if (s.range == hull.back().range) hull.pop_back();
        while (hull.size() > 1 && isBelow(hull[hull.size() - 2], hull.back(), s)) hull.pop_back();
        hull.push_back(s);
    }
    for (std::size_t i = 1; i < hull.size(); ++i) {
        const FilterSample &a = hull[i - 1], &b = hull[i];
        if (b.error <= a.error) break;
        if (b.range < mean && i + 1 < hull.size()) continue;
        const double weight = (b.error - a.error) / (b.range - a.range);
        return {a.error - weight * a.range, weight};
    }
    return {max, 0};
}

TextureSampling probeTextures(Device& device, TexturePrecision precision) {
    TextureSampling result;
    result.linear = probeDecode(device, false, precision);
    result.srgb = probeDecode(device, true, precision);
    const auto bound = [&](bool srgb) {
        std::vector<FilterSample> samples;
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            const std::vector<FilterSample> more =
                probeFilter(device, srgb, result.decode(srgb), seed, precision);
            samples.insert(samples.end(), more.begin(), more.end());
        }
        return boundOf(samples);
    };
    result.linear_filter = bound(false);
    result.srgb_filter = bound(true);
    return result;
}

std::vector<DeviceProperty> textureProperties(const Device& device, const TextureSampling& sampling,
                                              const TextureSampling& exact) {
    // Vulkan: weights have at least subTexelPrecisionBits, and sRGB keeps 8 bits, so half a code.
    const double fraction = std::exp2(-static_cast<double>(device.limits().subTexelPrecisionBits));
    const auto decode = [](const char* what, const TextureSampling& s) {
        double max = 0, halfCode = 0;
        std::size_t worst = 0;
        for (std::size_t code = 1; code < 256; ++code) {
            const double off = s.srgbError(code) / exactSrgb(code);
            if (off > max) {
                max = off, worst = code;
                halfCode = (exactSrgb(code) - exactSrgb(code - 1)) / (2 * exactSrgb(code));
            }
        }
        return DeviceProperty{what, max <= 1e-3, false,
                              fmt::format("error up to {:.2g} %, at code {}; Vulkan allows {:.2g} %",
                                          100 * max, worst, 100 * halfCode)};
    };
    const auto filter = [&](const char* what, const FilterBound& bound) {
        return DeviceProperty{
            what, bound.rounding < 0.1 / 255, false,
            fmt::format("error up to {:.2g} of a code plus {:.2g} % of the texels' difference; "
                        "Vulkan allows {:.2g} %",
                        bound.rounding * 255, 100 * bound.weight, 100 * fraction)};
    };
    return {decode("decodes sRGB to 0.1 %", sampling),
            filter("filters 8-bit texels without rounding", sampling.linear_filter),
            filter("filters 8-bit sRGB texels without rounding", sampling.srgb_filter),
            decode("decodes --textures exact to 0.1 %", exact),
            filter("filters --textures exact without rounding", exact.linear_filter),
            filter("filters --textures exact sRGB without rounding", exact.srgb_filter)};
}

Scene withDecodedColors(Scene scene, const TexelDecode& srgb) {
    std::map<int, int> decodedOf;  // texture -> its copy with the decoded image
    const auto decoded = [&](int texture) {
        const auto [entry, isNew] = decodedOf.try_emplace(texture, texture);
        const Texture old = scene.textures[static_cast<std::size_t>(texture)];
        const TextureImage& image = scene.images[static_cast<std::size_t>(old.image)];
        if (!isNew || image.rgba.empty()) return entry->second;
        TextureImage floats{image.name, image.width, image.height, {}};
        for (std::size_t i = 0; i < image.rgba.size(); ++i)
            floats.rgba32.push_back(i % 4 == 3 ? static_cast<float>(image.rgba[i]) / 255
                                               : srgb[image.rgba[i]]);
        entry->second = static_cast<int>(scene.textures.size());
        scene.textures.push_back({static_cast<int>(scene.images.size()), old.sampler});
        scene.images.push_back(std::move(floats));
        return entry->second;
    };
    for (Material& material : scene.materials)
        for (std::size_t slot = 0; slot < materialSlots.size(); ++slot)
            if (materialSlots[slot].srgb && readsSlot(material, slot)) {
                int& texture = (material.*materialSlots[slot].texture).texture;
                texture = decoded(texture);
            }
    return scene;
}

}  // namespace diptych
