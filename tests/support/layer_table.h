// SPDX-License-Identifier: MIT
// Layers of materials, restated from the glTF extensions. Every row is tried by the reader (GltfLayer), by
// animations (GltfAnimationPointer), by the reference (ReferenceLayer) and in both paths (EachLayer).
#pragma once

#include "shared/contract/debug_mode.h"
#include "shared/contract/material.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/motion.h"
#include "tests/support/srgb.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

namespace diptych {

// A factor of KHR_materials_<extension>. Of a number, vectors have it in x.
struct LayerFactor {
    const char *extension, *key;
    std::variant<float Material::*, glm::vec3 Material::*> member;
    AnimatedPart part;
    glm::vec3 initial, typical;
    double min, max;                      // values beyond are clamped
    std::optional<Channel> channel = {};  // of factors without a texture

    std::size_t width() const { return member.index() == 0 ? 1 : 3; }
    glm::vec3 of(const Material& m) const {
        const auto* const number = std::get_if<0>(&member);
        return number ? glm::vec3(m.**number, 0, 0) : m.*std::get<1>(member);
    }
    void set(Material& m, const glm::vec3& value) const {
        if (const auto* const number = std::get_if<0>(&member))
            m.** number = value.x;
        else
            m.*std::get<1>(member) = value;
    }
};

// A texture of KHR_materials_<extension>, and the channel that shows it.
struct LayerTexture {
    const char *extension, *key;
    gpu::uint slot;
    Channel channel;
    std::string components;  // of r, g, b, a; rgb: a colour; empty: a direction
    std::size_t factor = 0;  // its index in the row
    bool between = false;    // the texel mixes this factor and the next one, which is alone without a texture

    TextureSlot& of(Material& m) const { return m.*materialSlots[slot].texture; }
    const TextureSlot& of(const Material& m) const { return m.*materialSlots[slot].texture; }
    // The texel's components, 0 to 1, as the channel has them; colours are sRGB.
    glm::dvec3 read(const glm::dvec4& texel) const {
        if (components == "rgb") return {decodedSrgb(texel.r), decodedSrgb(texel.g), decodedSrgb(texel.b)};
        return {texel[static_cast<int>(std::string("rgba").find(components))], 0, 0};
    }
};

struct TestedLayer {
    const char* name;
    gpu::uint bit;                       // LAYER_*
    std::vector<LayerFactor> factors;    // the first removes the layer if it is 0
    std::vector<LayerTexture> textures;  // the first is of that factor

    Material typical(Material m = {}) const {
        for (const LayerFactor& f : factors) f.set(m, f.typical);
        return m;
    }
    // The same with all its textures, but without the layer.
    Material off(Material m, int texture) const {
        m = typical(m);
        for (const LayerTexture& t : textures) t.of(m).texture = texture;
        factors[0].set(m, glm::vec3(0));
        return m;
    }
    // The channel's value where the surface has the layer and the texture has this texel.
    glm::dvec3 shown(const LayerTexture& t, const Material& m, const glm::dvec4& texel) const {
        const glm::dvec3 factor(factors[t.factor].of(m)), read = t.read(texel);
        return t.between ? glm::mix(factor, glm::dvec3(factors[t.factor + 1].of(m)), read.x) : factor * read;
    }
    // Channels of surfaces that are 0 without the layer.
    std::vector<Channel> channels() const {
        std::vector<Channel> own;
        for (const DebugMode& mode : debugModes())
            if (layerOf(mode.channel) == bit && !isShaded(mode.channel)) own.push_back(mode.channel);
        return own;
    }
    friend void PrintTo(const TestedLayer& layer, std::ostream* os) { *os << layer.name; }
};

inline const std::vector<TestedLayer>& testedLayers() {
    using M = Material;
    using P = AnimatedPart;
    using C = Channel;
    constexpr double any = std::numeric_limits<double>::infinity(), large = 1e12;
    constexpr glm::vec3 none(0), white(1), color(0.5f, 0.75f, 0.25f);
    constexpr auto number = [](float x) { return glm::vec3(x, 0, 0); };
    constexpr auto coat = "clearcoat", brushed = "anisotropy", sheen = "sheen", film = "iridescence",
                   glass = "transmission", volume = "volume", leaf = "diffuse_transmission";
    // clang-format off
    static const std::vector<TestedLayer> all{
        {"clearcoat", gpu::LAYER_CLEARCOAT,
         {{coat, "clearcoatFactor", &M::clearcoat, P::clearcoat, none, number(0.5f), 0, 1},
          {coat, "clearcoatRoughnessFactor", &M::clearcoat_roughness, P::clearcoat_roughness, none,
           number(0.8f), 0, 1}},
         {{coat, "clearcoatTexture", gpu::SLOT_clearcoat, C::clearcoat, "r"},
          {coat, "clearcoatRoughnessTexture", gpu::SLOT_clearcoat_roughness, C::clearcoat_roughness, "g", 1},
          {coat, "clearcoatNormalTexture", gpu::SLOT_clearcoat_normal, C::clearcoat_normal, ""}}},
        {"anisotropy", gpu::LAYER_ANISOTROPY,
         {{brushed, "anisotropyStrength", &M::anisotropy, P::anisotropy, none, number(0.6f), 0, 1},
          {brushed, "anisotropyRotation", &M::anisotropy_rotation, P::anisotropy_rotation, none, number(-100),
           -any, any}},
         {{brushed, "anisotropyTexture", gpu::SLOT_anisotropy, C::anisotropy, "b"}}},
        {"sheen", gpu::LAYER_SHEEN,
         {{sheen, "sheenColorFactor", &M::sheen_color, P::sheen_color, none, color, 0, 1},
          {sheen, "sheenRoughnessFactor", &M::sheen_roughness, P::sheen_roughness, none, number(0.7f), 0, 1}},
         {{sheen, "sheenColorTexture", gpu::SLOT_sheen_color, C::sheen_color, "rgb"},
          {sheen, "sheenRoughnessTexture", gpu::SLOT_sheen_roughness, C::sheen_roughness, "a", 1}}},
        {"iridescence", gpu::LAYER_IRIDESCENCE,
         {{film, "iridescenceFactor", &M::iridescence, P::iridescence, none, number(0.8f), 0, 1},
          {film, "iridescenceIor", &M::iridescence_ior, P::iridescence_ior, number(1.3f), number(1.6f), 1,
           large, C::iridescence_ior},
          // The minimum may be above the maximum.
          {film, "iridescenceThicknessMinimum", &M::iridescence_thickness_min,
           P::iridescence_thickness_min, number(100), number(600), 0, 65504},
          {film, "iridescenceThicknessMaximum", &M::iridescence_thickness_max, P::iridescence_thickness_max,
           number(400), number(200), 0, 65504}},
         {{film, "iridescenceTexture", gpu::SLOT_iridescence, C::iridescence, "r"},
          {film, "iridescenceThicknessTexture", gpu::SLOT_iridescence_thickness, C::iridescence_thickness,
           "g", 2, true}}},
        {"transmission", gpu::LAYER_TRANSMISSION,
         {{glass, "transmissionFactor", &M::transmission, P::transmission, none, number(0.5f), 0, 1},
          {volume, "thicknessFactor", &M::thickness, P::thickness, none, number(2), 0, large},
          // 0: infinite, which files express by leaving it out.
          {volume, "attenuationDistance", &M::attenuation_distance, P::attenuation_distance, none,
           number(0.5f), 1e-12, large, C::attenuation_distance},
          {volume, "attenuationColor", &M::attenuation_color, P::attenuation_color, white, color, 0, 1,
           C::attenuation_color},
          {"dispersion", "dispersion", &M::dispersion, P::dispersion, none, number(5), 0, large,
           C::dispersion}},
         {{glass, "transmissionTexture", gpu::SLOT_transmission, C::transmission, "r"},
          {volume, "thicknessTexture", gpu::SLOT_thickness, C::transmission_thickness, "g", 1}}},
        {"diffuse_transmission", gpu::LAYER_DIFFUSE_TRANSMISSION,
         {{leaf, "diffuseTransmissionFactor", &M::diffuse_transmission, P::diffuse_transmission, none,
           number(0.6f), 0, 1},
          {leaf, "diffuseTransmissionColorFactor", &M::diffuse_transmission_color,
           P::diffuse_transmission_color, white, color, 0, 1}},
         {{leaf, "diffuseTransmissionTexture", gpu::SLOT_diffuse_transmission, C::diffuse_transmission, "a"},
          {leaf, "diffuseTransmissionColorTexture", gpu::SLOT_diffuse_transmission_color,
           C::diffuse_transmission_color, "rgb", 1}}}};
    // clang-format on
    return all;
}

inline std::vector<TestedLayer> testedLayers(gpu::uint bits) {
    std::vector<TestedLayer> some = testedLayers();
    std::erase_if(some, [&](const TestedLayer& layer) { return (layer.bit & bits) == 0; });
    return some;
}

// The name of a row, for INSTANTIATE_TEST_SUITE_P.
constexpr auto layerName = [](const auto& info) { return std::string(info.param.name); };

}  // namespace diptych
