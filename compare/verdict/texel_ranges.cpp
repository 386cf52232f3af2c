// SPDX-License-Identifier: MIT
#include "compare/verdict/texel_ranges.h"

#include "compare/verdict/surface_grid.h"
#include "shared/contract/debug_mode.h"
#include "shared/contract/material.h"
#include "shared/frame/debug_modes.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/image/mipmap.h"
#include "shared/scene/model/material_slots.h"

#include <tbb/parallel_for.h>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace diptych {
namespace {

// Vulkan 1.3, 16.5.7: a device may take a derivative's length anywhere from its largest component to
// sqrt(2) times the sum of its components: half a level below the exact one and a level above it.
constexpr double levelBelow = 0.5, levelAbove = 1;
// A linear filter mixes texels whose centres are less than one texel away. So this many on each side may
// be visible, even from half a texel beside, more than the steps by which two devices place a vertex.
constexpr int texelMargin = 1;

using Factors = std::array<double, 4>;  // of a texel's components

// Contribution of a texel's components to a channel: `factor` times the component's range.
struct Use {
    Channel mode;
    Factors factor;
    // Whether texels of 0 take the layer away, so that the channel is 0 there: then `factor` is its largest
    // value, and the difference where such texels and others may be visible.
    bool removes = false;
};

double largestComponent(const auto& v) {
    return double{std::max({v.x, v.y, v.z})};
}
double sizeOf(float factor) {
    return double{factor};
}
double sizeOf(const auto& color) {
    return largestComponent(color);
}

// The material's factor of each component of a slot's texels.
Factors factorsOf(const Material& m, std::size_t slot) {
    switch (slot) {
        case gpu::SLOT_metallic_roughness:
            return {0, m.roughness, m.metallic, 0};
        case gpu::SLOT_anisotropy:
            return {1, 1, m.anisotropy, 0};
        case gpu::SLOT_iridescence_thickness:
            return {0, std::abs(double{m.iridescence_thickness_max} - m.iridescence_thickness_min), 0, 0};
        default:
            break;
    }
#define DIPTYCH_SIZE(number, name, colors, reads, layer, factor, words) sizeOf(m.factor),
    const std::array<double, gpu::SLOT_COUNT> sizes{MATERIAL_SLOTS(DIPTYCH_SIZE)};
#undef DIPTYCH_SIZE
    const bool bumps = slot == gpu::SLOT_normal || slot == gpu::SLOT_clearcoat_normal;
    Factors factors{};
    for (std::size_t c = 0; c < 4; ++c)
        if ((materialSlots[slot].components >> c & 1u) != 0)
            factors.at(c) = bumps ? std::max(1.0, std::abs(sizes.at(slot))) : sizes.at(slot);
    return factors;
}

// Units of the channel per unit of the components 2 t - 1 of a direction; 1 for other texels.
double unitsPer(Channel mode) {
    const DebugMode& of = debugMode(mode);
    constexpr double three = 2 * 1.7320508 * degreesPerRadian, two = 2 * 1.4142136 * degreesPerRadian;
    if (of.texels == TexelUse::line) return two;
    if (of.texels != TexelUse::direction) return 1;
    return isAngle(of.error_kind) ? three : three / degreesPerRadian;
}

struct Reading {
    Channel mode;
    std::size_t slot;
    unsigned components;
};
constexpr Reading readings[] = {
#define DIPTYCH_READING(channel, slot, components) {Channel::channel, gpu::SLOT_##slot, texel::components},
    CHANNEL_TEXELS(DIPTYCH_READING)
#undef DIPTYCH_READING
};

Use scaledUse(Channel mode, unsigned components, const Factors& factors, double times = 1) {
    Use use{mode, {}};
    for (std::size_t c = 0; c < 4; ++c)
        if ((components >> c & 1u) != 0) use.factor.at(c) = times * factors.at(c);
    return use;
}

// Uses that depend on more than one texture, or on the kind of material.
void addCombined(std::vector<Use>& uses, const Material& m, std::size_t slot, const Factors& factors) {
    // The direction stays perpendicular to the normal.
    if (slot == gpu::SLOT_normal && m.anisotropy != 0)
        uses.push_back(
            scaledUse(Channel::anisotropy_direction, texel::rgb, factors, unitsPer(Channel::normals)));
    if (slot == gpu::SLOT_specular_color && m.specular_glossiness) {
        // F0 darkens the base, alpha is glossiness.
        uses.push_back(scaledUse(Channel::albedo, texel::rgb, factors, largestComponent(m.base_color)));
        uses.push_back(scaledUse(Channel::roughness, texel::a, {0, 0, 0, 1 - double{m.roughness}}));
    }
    if (slot == gpu::SLOT_sheen_color) {
        const double rough = m.sheen_roughness;
        uses.push_back({Channel::sheen_roughness, {rough, rough, rough, 0}, true});
    }
    if (slot == gpu::SLOT_diffuse_transmission)
        uses.push_back({Channel::diffuse_transmission_color,
                        {0, 0, 0, largestComponent(m.diffuse_transmission_color)},
                        true});
    if (slot == gpu::SLOT_thickness && diffusesThroughVolume(m)) {
        const glm::vec3& c = m.attenuation_color;  // the steepest change of exp(thickness log(color))
        const double min = std::max(double{std::min({c.x, c.y, c.z})}, 1e-37);
        uses.push_back({Channel::diffuse_transmission_color,
                        {0,
                         -std::log(min) * m.thickness / m.attenuation_distance *
                             largestComponent(m.diffuse_transmission_color),
                         0, 0}});
    }
    if (slot == gpu::SLOT_iridescence) {
        const double thickest = std::max(m.iridescence_thickness_min, m.iridescence_thickness_max);
        uses.push_back({Channel::iridescence_ior, {double{m.iridescence_ior}, 0, 0, 0}, true});
        uses.push_back({Channel::iridescence_thickness, {thickest, 0, 0, 0}, true});
    }
}

std::vector<Use> usesOf(const Material& m, std::size_t slot) {
    const Factors factors = factorsOf(m, slot);
    if (m.unlit && slot == gpu::SLOT_base_color) return {scaledUse(Channel::emission, texel::rgb, factors)};
    std::vector<Use> uses;
    for (const Reading& reading : readings)
        if (reading.slot == slot)
            uses.push_back(scaledUse(reading.mode, reading.components, factors, unitsPer(reading.mode)));
    addCombined(uses, m, slot, factors);
    return uses;
}

// Range of texels' components.
struct TexelRange {
    glm::dvec4 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};

    // Largest difference that it makes to a channel. `weight`: by how much two means of the texels may
    // differ, as a fraction of the range.
    double differs(const Use& use, double weight) const {
        double most_of_all = 0;
        for (int c = 0; c < 4; ++c) {
            const double size = max[c] - min[c], part = !use.removes              ? weight * size
                                                        : min[c] <= 0 && size > 0 ? 1
                                                                                  : 0;
            most_of_all = std::max(most_of_all, use.factor[static_cast<std::size_t>(c)] * part);
        }
        return most_of_all;
    }
};

// Range of the distance from a position to the next pixel, texels of level 0.
struct PixelTexels {
    double min = 0, max = 0;
};

// A texture's mip levels; texels are read in linear light.
class Levels {
public:
    Levels(const TextureImage& image, bool srgb, const Sampler& sampler)
        : sampler_(sampler),
          chain_(image, srgb,
                 image.deep() ? Texels::float32
                 : srgb       ? Texels::srgb8
                              : Texels::linear8),
          floats_(image.deep()),
          count_(sampler.mipmaps ? chain_.count() : 1) {
        for (std::size_t code = 0; code < 256; ++code) {
            linear_[code] = static_cast<double>(code) / 255;
            color_[code] = srgb ? exactSrgb(code) : linear_[code];
        }
    }

    // Range of each component among the texels that may be visible at a position.
    TexelRange rangeAt(const glm::dvec2& uv, const PixelTexels& texels) const {
        const auto levelOf = [&](double level) {
            return static_cast<std::size_t>(
                std::clamp(std::floor(level), 0.0, static_cast<double>(count_ - 1)));
        };
        TexelRange range;
        const std::size_t first = levelOf(std::log2(std::max(texels.min, 1e-9)) - levelBelow),
                          last = levelOf(std::log2(std::max(texels.max, 1e-9)) + levelAbove + 1);
        for (std::size_t k = first; k <= last; ++k) {
            const int width = chain_.width(k), height = chain_.height(k);
            const auto x = static_cast<long long>(std::floor(uv.x * width)),
                       y = static_cast<long long>(std::floor(uv.y * height));
            for (long long v = y - texelMargin; v <= y + texelMargin; ++v)
                for (long long u = x - texelMargin; u <= x + texelMargin; ++u) add(range, k, u, v);
        }
        return range;
    }
    TexelRange wholeRange() const {
        TexelRange range;
        for (int y = 0; y < chain_.height(); ++y)
            for (int x = 0; x < chain_.width(); ++x) add(range, 0, x, y);
        return range;
    }

private:
    static std::size_t wrapped(long long i, long long size, Wrap wrap) {
        if (wrap == Wrap::clamp_to_edge) return static_cast<std::size_t>(std::clamp(i, 0LL, size - 1));
        const long long period = wrap == Wrap::mirrored_repeat ? 2 * size : size;
        const long long at = (i % period + period) % period;
        return static_cast<std::size_t>(at < size ? at : period - 1 - at);
    }

    void add(TexelRange& range, std::size_t level, long long x, long long y) const {
        const int width = chain_.width(level), height = chain_.height(level);
        const std::size_t u = wrapped(x, width, sampler_.wrap_s), v = wrapped(y, height, sampler_.wrap_t);
        const std::size_t at = v * static_cast<std::size_t>(width) + u;
        const std::span<const std::byte> bytes = chain_.level(level);
        for (int c = 0; c < 4; ++c) {
            const std::size_t i = 4 * at + static_cast<std::size_t>(c);
            double value = 0;
            if (floats_) {
                float f = 0;
                std::memcpy(&f, &bytes[4 * i], sizeof f);
                value = f;
            } else {
                const auto code = std::to_integer<std::size_t>(bytes[i]);
                value = c == 3 ? linear_[code] : color_[code];
            }
            range.min[c] = std::min(range.min[c], value);
            range.max[c] = std::max(range.max[c], value);
        }
    }

    Sampler sampler_;
    MipChain chain_;
    bool floats_;
    std::size_t count_;
    std::array<double, 256> linear_{}, color_{};
};

// Distance to the next pixel in a slot's texture coordinates, texels of level 0: the larger of across and
// down, by the side with the smallest and by the one with the largest change. Empty if neither side shows
// the same surface.
std::optional<PixelTexels> texelsOfPixel(const Image& uv, const SurfaceAround& surface,
                                         const TextureSlot& slot, const TextureImage& image,
                                         std::size_t here) {
    const int x = static_cast<int>(here) % uv.width, y = static_cast<int>(here) / uv.width;
    PixelTexels texels;
    for (const int axis : {0, 1}) {
        double min = std::numeric_limits<double>::infinity(), max = 0;
        for (const int side : {-1, 1}) {
            const int u = x + (axis == 0 ? side : 0), v = y + (axis == 1 ? side : 0);
            if (u < 0 || v < 0 || u >= uv.width || v >= uv.height) continue;
            const std::size_t there = indexOf(uv, u, v);
            if (!surface.same(here, there)) continue;
            const double du = double{uv.pixel(there)[0]} - uv.pixel(here)[0],
                         dv = double{uv.pixel(there)[1]} - uv.pixel(here)[1];
            const double distance = std::hypot((slot.u.x * du + slot.u.y * dv) * image.width,
                                               (slot.v.x * du + slot.v.y * dv) * image.height);
            const double other = surface.normalAngle(here, there) > 6 ? 2 : 1;
            min = std::min(min, distance / other);
            max = std::max(max, distance * other);
        }
        if (std::isinf(min)) return {};
        texels = {std::max(texels.min, min), std::max(texels.max, max)};
    }
    return texels;
}

}  // namespace

std::map<Channel, Image> texelRanges(const Scene& scene, const Frame& frame,
                                     const std::array<DevicePrecision, 2>& devices) {
    std::map<Channel, Image> ranges;
    const Image *ids = findChannel(frame, Channel::material_id), *uv = findChannel(frame, Channel::texcoords);
    if (!ids) return ranges;
    std::vector<std::vector<std::size_t>> pixels(scene.materials.size());
    for (std::size_t i = 0; i < ids->pixels(); ++i)
        if (const float id = *ids->pixel(i); id >= 0 && static_cast<std::size_t>(id) < pixels.size())
            pixels[static_cast<std::size_t>(id)].push_back(i);
    const SurfaceAround surface(frame);
    const double placed = stepOf(devices, &DevicePrecision::sub_pixel_bits),
                 weighed = stepOf(devices, &DevicePrecision::sub_texel_bits);
    for (std::size_t id = 0; id < scene.materials.size(); ++id)
        for (std::size_t s = 0; s < materialSlots.size() && !pixels[id].empty(); ++s) {
            const Material& material = scene.materials[id];
            if (!readsSlot(material, s)) continue;
            const TextureSlot& slot = slotOf(material, s);
            const Texture& texture = textureOf(scene, slot);
            const TextureImage& image = imageOf(scene, slot);
            const Levels levels(image, materialSlots[s].srgb, texture.sampler);
            const std::vector<Use> uses = usesOf(material, s);
            for (const Use& use : uses) ranges.try_emplace(use.mode, ids->width, ids->height, 1);
            // An animation may move a texture.
            const bool known =
                uv && slot.texcoord == 0 && !scene.material_parts.contains(static_cast<int>(id));
            const TexelRange all = levels.wholeRange();
            tbb::parallel_for(std::size_t{0}, pixels[id].size(), [&](std::size_t k) {
                const std::size_t i = pixels[id][k];
                const std::optional<PixelTexels> texels =
                    known ? texelsOfPixel(*uv, surface, slot, image, i) : std::nullopt;
                TexelRange range = all;
                double weight = 1;
                if (texels) {
                    const glm::dvec3 at(uv->pixel(i)[0], uv->pixel(i)[1], 1);
                    const glm::dvec2 position(slot.u.x * at.x + slot.u.y * at.y + slot.u.z,
                                              slot.v.x * at.x + slot.v.y * at.y + slot.v.z);
                    range = levels.rangeAt(position, *texels);
                    // Magnified: two steps of the weights, and the movement of the position by a vertex
                    // step.
                    if (texture.sampler.magnify_linear && std::log2(texels->max) + levelAbove < 0)
                        weight = std::min(1.0, 2 * (weighed + placed * texels->max));
                }
                for (const Use& use : uses)
                    *ranges.at(use.mode).pixel(i) += static_cast<float>(range.differs(use, weight));
            });
        }
    return ranges;
}

}  // namespace diptych
