// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/animation_pointer.h"

#include "shared/contract/material.h"
#include "shared/scene/gltf/motion_budget.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace diptych::gltf {

namespace {

// {} matches an index.
struct Pattern {
    std::string_view text;
    AnimatedPart part;
    int slot = 0;
};

constexpr Pattern pointerPatterns[] = {
    {"/nodes/{}/translation", AnimatedPart::translation},
    {"/nodes/{}/rotation", AnimatedPart::rotation},
    {"/nodes/{}/scale", AnimatedPart::scale},
    {"/nodes/{}/weights", AnimatedPart::weights},
    {"/nodes/{}/weights/{}", AnimatedPart::weight},
    {"/meshes/{}/weights", AnimatedPart::mesh_weights},
    {"/meshes/{}/weights/{}", AnimatedPart::mesh_weight},
    {"/extensions/KHR_lights_punctual/lights/{}/color", AnimatedPart::light_color},
    {"/extensions/KHR_lights_punctual/lights/{}/intensity", AnimatedPart::light_intensity},
    {"/extensions/KHR_lights_punctual/lights/{}/range", AnimatedPart::light_range},
    {"/extensions/KHR_lights_punctual/lights/{}/spot/innerConeAngle", AnimatedPart::light_inner_cone},
    {"/extensions/KHR_lights_punctual/lights/{}/spot/outerConeAngle", AnimatedPart::light_outer_cone},
    {"/cameras/{}/perspective/yfov", AnimatedPart::camera_yfov},
    {"/cameras/{}/perspective/aspectRatio", AnimatedPart::camera_aspect},
    {"/cameras/{}/perspective/znear", AnimatedPart::camera_near},
    {"/cameras/{}/perspective/zfar", AnimatedPart::camera_far},
    {"/cameras/{}/orthographic/ymag", AnimatedPart::camera_ymag},
    {"/cameras/{}/orthographic/xmag", AnimatedPart::camera_xmag},
    {"/cameras/{}/orthographic/znear", AnimatedPart::camera_near},
    {"/cameras/{}/orthographic/zfar", AnimatedPart::camera_far},
    {"/materials/{}/pbrMetallicRoughness/baseColorFactor", AnimatedPart::base_color},
    {"/materials/{}/pbrMetallicRoughness/metallicFactor", AnimatedPart::metallic},
    {"/materials/{}/pbrMetallicRoughness/roughnessFactor", AnimatedPart::roughness},
    {"/materials/{}/emissiveFactor", AnimatedPart::emissive},
    {"/materials/{}/normalTexture/scale", AnimatedPart::normal_scale, gpu::SLOT_normal},
    {"/materials/{}/occlusionTexture/strength", AnimatedPart::occlusion_strength, gpu::SLOT_occlusion},
    {"/materials/{}/alphaCutoff", AnimatedPart::alpha_cutoff},
    {"/materials/{}/extensions/KHR_materials_emissive_strength/emissiveStrength",
     AnimatedPart::emissive_strength},
    {"/materials/{}/extensions/KHR_materials_ior/ior", AnimatedPart::ior},
    {"/materials/{}/extensions/KHR_materials_specular/specularFactor", AnimatedPart::specular},
    {"/materials/{}/extensions/KHR_materials_specular/specularColorFactor", AnimatedPart::specular_color},
    {"/materials/{}/extensions/KHR_materials_transmission/transmissionFactor", AnimatedPart::transmission},
    {"/materials/{}/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", AnimatedPart::base_color},
    {"/materials/{}/extensions/KHR_materials_pbrSpecularGlossiness/specularFactor",
     AnimatedPart::specular_f0},
    {"/materials/{}/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor",
     AnimatedPart::glossiness},
    {"/materials/{}/extensions/KHR_materials_clearcoat/clearcoatFactor", AnimatedPart::clearcoat},
    {"/materials/{}/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor",
     AnimatedPart::clearcoat_roughness},
    {"/materials/{}/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale",
     AnimatedPart::clearcoat_normal_scale, gpu::SLOT_clearcoat_normal},
    {"/materials/{}/extensions/KHR_materials_anisotropy/anisotropyStrength", AnimatedPart::anisotropy},
    {"/materials/{}/extensions/KHR_materials_anisotropy/anisotropyRotation",
     AnimatedPart::anisotropy_rotation},
    {"/materials/{}/extensions/KHR_materials_sheen/sheenColorFactor", AnimatedPart::sheen_color},
    {"/materials/{}/extensions/KHR_materials_sheen/sheenRoughnessFactor", AnimatedPart::sheen_roughness},
    {"/materials/{}/extensions/KHR_materials_iridescence/iridescenceFactor", AnimatedPart::iridescence},
    {"/materials/{}/extensions/KHR_materials_iridescence/iridescenceIor", AnimatedPart::iridescence_ior},
    {"/materials/{}/extensions/KHR_materials_iridescence/iridescenceThicknessMinimum",
     AnimatedPart::iridescence_thickness_least},
    {"/materials/{}/extensions/KHR_materials_iridescence/iridescenceThicknessMaximum",
     AnimatedPart::iridescence_thickness_most},
    {"/materials/{}/extensions/KHR_materials_volume/thicknessFactor", AnimatedPart::thickness},
    {"/materials/{}/extensions/KHR_materials_volume/attenuationDistance", AnimatedPart::attenuation_distance},
    {"/materials/{}/extensions/KHR_materials_volume/attenuationColor", AnimatedPart::attenuation_color},
    {"/materials/{}/extensions/KHR_materials_dispersion/dispersion", AnimatedPart::dispersion},
    {"/materials/{}/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionFactor",
     AnimatedPart::diffuse_transmission},
    {"/materials/{}/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor",
     AnimatedPart::diffuse_transmission_color},
};

// Paths to a material's textures; one of transformPatterns follows.
constexpr Pattern texturePatterns[] = {
    {"/materials/{}/pbrMetallicRoughness/baseColorTexture", {}, gpu::SLOT_base_color},
    {"/materials/{}/pbrMetallicRoughness/metallicRoughnessTexture", {}, gpu::SLOT_metallic_roughness},
    {"/materials/{}/normalTexture", {}, gpu::SLOT_normal},
    {"/materials/{}/occlusionTexture", {}, gpu::SLOT_occlusion},
    {"/materials/{}/emissiveTexture", {}, gpu::SLOT_emissive},
    {"/materials/{}/extensions/KHR_materials_specular/specularTexture", {}, gpu::SLOT_specular},
    {"/materials/{}/extensions/KHR_materials_specular/specularColorTexture", {}, gpu::SLOT_specular_color},
    {"/materials/{}/extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture", {}, gpu::SLOT_base_color},
    {"/materials/{}/extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture",
     {},
     gpu::SLOT_specular_color},
    {"/materials/{}/extensions/KHR_materials_clearcoat/clearcoatTexture", {}, gpu::SLOT_clearcoat},
    {"/materials/{}/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture",
     {},
     gpu::SLOT_clearcoat_roughness},
    {"/materials/{}/extensions/KHR_materials_clearcoat/clearcoatNormalTexture",
     {},
     gpu::SLOT_clearcoat_normal},
    {"/materials/{}/extensions/KHR_materials_anisotropy/anisotropyTexture", {}, gpu::SLOT_anisotropy},
    {"/materials/{}/extensions/KHR_materials_sheen/sheenColorTexture", {}, gpu::SLOT_sheen_color},
    {"/materials/{}/extensions/KHR_materials_sheen/sheenRoughnessTexture", {}, gpu::SLOT_sheen_roughness},
    {"/materials/{}/extensions/KHR_materials_iridescence/iridescenceTexture", {}, gpu::SLOT_iridescence},
    {"/materials/{}/extensions/KHR_materials_iridescence/iridescenceThicknessTexture",
     {},
     gpu::SLOT_iridescence_thickness},
    {"/materials/{}/extensions/KHR_materials_transmission/transmissionTexture", {}, gpu::SLOT_transmission},
    {"/materials/{}/extensions/KHR_materials_volume/thicknessTexture", {}, gpu::SLOT_thickness},
    {"/materials/{}/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionTexture",
     {},
     gpu::SLOT_diffuse_transmission},
    {"/materials/{}/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorTexture",
     {},
     gpu::SLOT_diffuse_transmission_color},
};
constexpr Pattern transformPatterns[] = {
    {"/extensions/KHR_texture_transform/offset", AnimatedPart::texture_offset},
    {"/extensions/KHR_texture_transform/rotation", AnimatedPart::texture_rotation},
    {"/extensions/KHR_texture_transform/scale", AnimatedPart::texture_scale},
};

// RFC 6901: no sign, no leading zero.
std::optional<int> indexOf(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text[0] == '-') return std::nullopt;
    if (text.size() > 1 && text[0] == '0') return std::nullopt;
    return value;
}

// The indices in a pointer that begins with the pattern; `rest`: the remainder.
std::optional<std::vector<int>> indicesIn(std::string_view pointer, std::string_view pattern,
                                          std::string_view& rest) {
    std::vector<int> indices;
    while (!pattern.empty()) {
        const std::size_t plain = pattern.find("{}");
        if (!pointer.starts_with(pattern.substr(0, plain))) return std::nullopt;
        if (plain == pattern.npos) {
            pointer.remove_prefix(pattern.size());
            break;
        }
        pointer.remove_prefix(plain);
        pattern.remove_prefix(plain + 2);
        const std::string_view token = pointer.substr(0, pointer.find('/'));
        const std::optional<int> index = indexOf(token);
        if (!index) return std::nullopt;
        indices.push_back(*index);
        pointer.remove_prefix(token.size());
    }
    rest = pointer;
    return indices;
}

struct Match {
    AnimatedPart part;
    int slot;
    std::vector<int> indices;
};

std::optional<Match> matchOf(std::string_view pointer) {
    std::string_view rest;
    for (const Pattern& pattern : pointerPatterns)
        if (auto indices = indicesIn(pointer, pattern.text, rest); indices && rest.empty())
            return Match{pattern.part, pattern.slot, std::move(*indices)};
    for (const Pattern& texture : texturePatterns)
        if (auto indices = indicesIn(pointer, texture.text, rest))
            for (const Pattern& transform : transformPatterns)
                if (rest == transform.text) return Match{transform.part, texture.slot, std::move(*indices)};
    return std::nullopt;
}

// Only ~0 (for ~) is decoded: no name that is read contains /, which ~1 encodes.
std::string unescaped(std::string_view pointer) {
    std::string text;
    for (std::size_t i = 0; i < pointer.size(); ++i) {
        const bool escaped = pointer[i] == '~' && i + 1 < pointer.size() && pointer[i + 1] == '0';
        text += pointer[i];
        i += escaped;
    }
    return text;
}

class Resolver {
public:
    Resolver(const tinygltf::Model& model, const std::string& pointer, const std::string& who)
        : model_(model), pointer_(oneLine(pointer)), who_(who) {}

    ChannelTarget resolve(const Match& match) const {
        ChannelTarget target{match.part, match.indices[0], 0};
        switch (match.part) {
            case AnimatedPart::translation:
            case AnimatedPart::rotation:
            case AnimatedPart::scale:
            case AnimatedPart::weights:
            case AnimatedPart::weight:
                weightOf(targetsOf(model_, item(model_.nodes, target.object)), match, target);
                return target;
            case AnimatedPart::mesh_weights:
            case AnimatedPart::mesh_weight:
                weightOf(targetsOf(item(model_.meshes, target.object)), match, target);
                return target;
            case AnimatedPart::light_color:
            case AnimatedPart::light_intensity:
            case AnimatedPart::light_range:
            case AnimatedPart::light_inner_cone:
            case AnimatedPart::light_outer_cone:
                light(item(model_.lights, target.object), target);
                return target;
            case AnimatedPart::camera_yfov:
            case AnimatedPart::camera_aspect:
            case AnimatedPart::camera_ymag:
            case AnimatedPart::camera_xmag:
            case AnimatedPart::camera_near:
            case AnimatedPart::camera_far:
                camera(item(model_.cameras, target.object), target);
                return target;
            default:
                material(item(model_.materials, target.object), match, target);
                return target;
        }
    }

private:
    const tinygltf::Model& model_;
    std::string pointer_;
    const std::string& who_;

    [[noreturn]] void wrong(const std::string& why) const {
        fail(who_, fmt::format("pointer \"{}\": {}", pointer_, why));
    }

    template <class Item>
    const Item& item(const std::vector<Item>& items, int index) const {
        if (static_cast<std::size_t>(index) >= items.size())
            wrong(fmt::format("the file has {}", items.size()));
        return items[static_cast<std::size_t>(index)];
    }

    void weightOf(std::size_t targets, const Match& match, ChannelTarget& target) const {
        if (match.indices.size() < 2) return;
        if (static_cast<std::size_t>(match.indices[1]) >= targets)
            wrong(fmt::format("the mesh has {} morph targets", targets));
        target.element = match.indices[1];
    }

    void light(const tinygltf::Light& light, ChannelTarget& target) const {
        const bool cone =
            target.part == AnimatedPart::light_inner_cone || target.part == AnimatedPart::light_outer_cone;
        if (cone) target.effect = light.type == "spot";
        if (target.part != AnimatedPart::light_range) return;
        target.effect = light.type != "directional";
        if (light.range == 0) wrong("the light has no range");
    }

    void camera(const tinygltf::Camera& camera, const ChannelTarget& target) const {
        const bool perspective = camera.type == "perspective";
        if (perspective != (pointer_.find("/perspective/") != pointer_.npos))
            wrong(fmt::format("the camera is {}", oneLine(camera.type)));
        if (target.part == AnimatedPart::camera_far && perspective && camera.perspective.zfar == 0)
            wrong("the camera has no zfar");
        if (target.part == AnimatedPart::camera_aspect && camera.perspective.aspectRatio == 0)
            wrong("the camera has no aspectRatio");
    }

    void material(const tinygltf::Material& material, const Match& match, ChannelTarget& target) const {
        const bool unlit = extension(material.extensions, "KHR_materials_unlit") != nullptr;
        const tinygltf::Value* glossy = extension(material.extensions, "KHR_materials_pbrSpecularGlossiness");
        const bool ofGlossy = names("/KHR_materials_pbrSpecularGlossiness/");
        if (ofGlossy && !glossy) wrong("the material has no KHR_materials_pbrSpecularGlossiness");
        const bool transform = target.part == AnimatedPart::texture_offset ||
                               target.part == AnimatedPart::texture_rotation ||
                               target.part == AnimatedPart::texture_scale;
        const bool textured = transform || target.part == AnimatedPart::normal_scale ||
                              target.part == AnimatedPart::occlusion_strength ||
                              target.part == AnimatedPart::clearcoat_normal_scale;
        if (textured && !hasTexture(material, match.slot, ofGlossy ? glossy : nullptr))
            wrong("the material has no such texture");
        if (transform) target.element = match.slot;
        target.effect = !unlit || target.part == AnimatedPart::base_color ||
                        target.part == AnimatedPart::alpha_cutoff ||
                        (transform && match.slot == gpu::SLOT_base_color);
        // Specular-glossiness replaces the core model and its extensions; unlit replaces both.
        const bool ofOthers = names("/pbrMetallicRoughness/") ||
                              (names("/KHR_materials_") && !names("/KHR_materials_emissive_strength/"));
        if (ofGlossy ? unlit : glossy && !unlit && ofOthers) target.effect = false;
    }

    bool names(std::string_view part) const { return pointer_.find(part) != pointer_.npos; }

    // `glossy`: KHR_materials_pbrSpecularGlossiness, if the texture is one of its own.
    static bool hasTexture(const tinygltf::Material& material, int slot, const tinygltf::Value* glossy) {
        if (glossy)
            return glossy->Has(slot == gpu::SLOT_base_color ? "diffuseTexture" : "specularGlossinessTexture");
        const auto has = [&](const char* of, const char* name) {
            const tinygltf::Value* e = extension(material.extensions, of);
            return e && e->Has(name);
        };
        switch (slot) {
            case gpu::SLOT_base_color:
                return material.pbrMetallicRoughness.baseColorTexture.index >= 0;
            case gpu::SLOT_metallic_roughness:
                return material.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0;
            case gpu::SLOT_normal:
                return material.normalTexture.index >= 0;
            case gpu::SLOT_occlusion:
                return material.occlusionTexture.index >= 0;
            case gpu::SLOT_emissive:
                return material.emissiveTexture.index >= 0;
            case gpu::SLOT_specular:
                return has("KHR_materials_specular", "specularTexture");
            case gpu::SLOT_specular_color:
                return has("KHR_materials_specular", "specularColorTexture");
            case gpu::SLOT_clearcoat:
                return has("KHR_materials_clearcoat", "clearcoatTexture");
            case gpu::SLOT_clearcoat_roughness:
                return has("KHR_materials_clearcoat", "clearcoatRoughnessTexture");
            case gpu::SLOT_clearcoat_normal:
                return has("KHR_materials_clearcoat", "clearcoatNormalTexture");
            case gpu::SLOT_anisotropy:
                return has("KHR_materials_anisotropy", "anisotropyTexture");
            case gpu::SLOT_sheen_color:
                return has("KHR_materials_sheen", "sheenColorTexture");
            case gpu::SLOT_sheen_roughness:
                return has("KHR_materials_sheen", "sheenRoughnessTexture");
            case gpu::SLOT_iridescence:
                return has("KHR_materials_iridescence", "iridescenceTexture");
            case gpu::SLOT_iridescence_thickness:
                return has("KHR_materials_iridescence", "iridescenceThicknessTexture");
            case gpu::SLOT_transmission:
                return has("KHR_materials_transmission", "transmissionTexture");
            case gpu::SLOT_thickness:
                return has("KHR_materials_volume", "thicknessTexture");
            case gpu::SLOT_diffuse_transmission:
                return has("KHR_materials_diffuse_transmission", "diffuseTransmissionTexture");
            default:
                return has("KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture");
        }
    }
};

}  // namespace

ChannelTarget pointerTarget(const tinygltf::Model& model, const std::string& pointer,
                            const std::string& who) {
    const std::optional<Match> match = matchOf(unescaped(pointer));
    if (!match)
        fail(who,
             fmt::format("pointer \"{}\" names a property that cannot be animated here", oneLine(pointer)));
    return Resolver(model, pointer, who).resolve(*match);
}

void keepPointerChannels(nlohmann::json& document) {
    const auto animations = document.find("animations");
    if (animations == document.end()) return;
    static const nlohmann::json::json_pointer pointer("/extensions/KHR_animation_pointer/pointer");
    for (nlohmann::json& animation : *animations)
        for (nlohmann::json& channel : animation["channels"]) {
            nlohmann::json& target = channel["target"];
            if (target.contains(pointer) && !target.contains("node")) target["node"] = 0;
        }
}

}  // namespace diptych::gltf
