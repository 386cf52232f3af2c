// SPDX-License-Identifier: MIT
// Layers of materials, restated from the glTF extensions. Every row is tried by the reader (GltfLayer), by
// animations (GltfAnimationPointer), by the reference (ReferenceLayer) and in both paths (EachLayer).
#pragma once

#include "shared/contract/debug_mode.h"
#include "shared/contract/material.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/motion.h"

#include <limits>
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
    double least, most;  // values beyond are clamped

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

// A texture of KHR_materials_<extension>: `channel` is its factor times these components of its texel, or
// has them otherwise.
struct LayerTexture {
    const char *extension, *key;
    gpu::uint slot;
    Channel channel;
    const char* components;  // of r, g, b, a; empty: a direction, or between two lengths

    TextureSlot& of(Material& m) const { return m.*materialSlots[slot].texture; }
    const TextureSlot& of(const Material& m) const { return m.*materialSlots[slot].texture; }
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
          {coat, "clearcoatRoughnessTexture", gpu::SLOT_clearcoat_roughness, C::clearcoat_roughness, "g"},
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
          {sheen, "sheenRoughnessTexture", gpu::SLOT_sheen_roughness, C::sheen_roughness, "a"}}},
        {"iridescence", gpu::LAYER_IRIDESCENCE,
         {{film, "iridescenceFactor", &M::iridescence, P::iridescence, none, number(0.8f), 0, 1},
          {film, "iridescenceIor", &M::iridescence_ior, P::iridescence_ior, number(1.3f), number(1.6f), 1,
           large},
          // The minimum may be above the maximum.
          {film, "iridescenceThicknessMinimum", &M::iridescence_thickness_least,
           P::iridescence_thickness_least, number(100), number(600), 0, 65504},
          {film, "iridescenceThicknessMaximum", &M::iridescence_thickness_most, P::iridescence_thickness_most,
           number(400), number(200), 0, 65504}},
         {{film, "iridescenceTexture", gpu::SLOT_iridescence, C::iridescence, "r"},
          {film, "iridescenceThicknessTexture", gpu::SLOT_iridescence_thickness, C::iridescence_thickness,
           ""}}},
        {"transmission", gpu::LAYER_TRANSMISSION,
         {{glass, "transmissionFactor", &M::transmission, P::transmission, none, number(0.5f), 0, 1},
          {volume, "thicknessFactor", &M::thickness, P::thickness, none, number(2), 0, large},
          // 0: infinite, which files express by leaving it out.
          {volume, "attenuationDistance", &M::attenuation_distance, P::attenuation_distance, none,
           number(0.5f), 1e-12, large},
          {volume, "attenuationColor", &M::attenuation_color, P::attenuation_color, white, color, 0, 1},
          {"dispersion", "dispersion", &M::dispersion, P::dispersion, none, number(5), 0, large}},
         {{glass, "transmissionTexture", gpu::SLOT_transmission, C::transmission, "r"},
          {volume, "thicknessTexture", gpu::SLOT_thickness, C::transmission_thickness, "g"}}},
        {"diffuse_transmission", gpu::LAYER_DIFFUSE_TRANSMISSION,
         {{leaf, "diffuseTransmissionFactor", &M::diffuse_transmission, P::diffuse_transmission, none,
           number(0.6f), 0, 1},
          {leaf, "diffuseTransmissionColorFactor", &M::diffuse_transmission_color,
           P::diffuse_transmission_color, white, color, 0, 1}},
         {{leaf, "diffuseTransmissionTexture", gpu::SLOT_diffuse_transmission, C::diffuse_transmission, "a"},
          {leaf, "diffuseTransmissionColorTexture", gpu::SLOT_diffuse_transmission_color,
           C::diffuse_transmission_color, "rgb"}}}};
    // clang-format on
    return all;
}

// The name of a row, for INSTANTIATE_TEST_SUITE_P.
constexpr auto layerName = [](const auto& info) { return std::string(info.param.name); };

}  // namespace diptych
