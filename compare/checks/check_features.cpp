// SPDX-License-Identifier: MIT
#include "compare/checks/check_features.h"

#include "shared/scene/model/material_slots.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace diptych {
namespace {

const Material& materialOf(const std::vector<Material>& materials, const Primitive& primitive) {
    return materials[static_cast<std::size_t>(primitive.material)];
}

// Calls use(slot index, slot) for each slot that the material reads.
template <class Use>
void forEachSlot(const Material& material, const Use& use) {
    for (std::size_t s = 0; s < materialSlots.size(); ++s)
        if (readsSlot(material, s)) use(s, slotOf(material, s));
}

// "Base colour and normal: TEXT": groups slots with equal text. Skips slots for which `textOf` returns an
// empty string.
template <class TextOf>
std::string bySlot(const Material& material, const TextOf& textOf) {
    std::vector<std::pair<std::string, std::string>> groups;  // text, slots
    forEachSlot(material, [&](std::size_t s, const TextureSlot& slot) {
        const std::string text = textOf(slot);
        if (text.empty()) return;
        const auto same = std::ranges::find(groups, text, &std::pair<std::string, std::string>::first);
        if (same == groups.end())
            groups.emplace_back(text, materialSlots[s].words);
        else
            same->second += fmt::format(" and {}", materialSlots[s].words);
    });
    std::string out;
    for (const auto& [text, slots] : groups)
        out += fmt::format("{}{}: {}", out.empty() ? "" : "; ", slots, text);
    if (!out.empty() && out[0] >= 'a') out[0] = static_cast<char>(out[0] - 'a' + 'A');
    return out;
}

// ---- texture transforms ------------------------------------------------------------------------------

// Recovers the parameters of KHR_texture_transform from the matrix. Mirroring becomes a negative second
// scale.
std::string transformOf(const TextureSlot& slot) {
    if (!isTransformed(slot)) return {};
    const double determinant = slot.u.x * slot.v.y - slot.u.y * slot.v.x;
    const double sx = std::hypot(slot.u.x, slot.v.x);
    const double sy = std::copysign(std::hypot(slot.u.y, slot.v.y), determinant);
    const double angle = sx > 0 ? std::atan2(0 - slot.v.x, slot.u.x) : std::atan2(slot.u.y, slot.v.y);
    // 1e-6: rounding of sines and cosines.
    const auto differ = [](double a, double b) { return std::abs(a - b) > 1e-6; };
    std::string out;
    const auto add = [&](const std::string& part) { out += (out.empty() ? "" : ", ") + part; };
    if (differ(slot.u.z, 0) || differ(slot.v.z, 0))
        add(fmt::format("offset {:.4g} {:.4g}", slot.u.z, slot.v.z));
    if (differ(angle, 0)) add(fmt::format("rotated {:.4g}\u00b0", glm::degrees(angle)));
    if (differ(sx, 1) || differ(sy, 1)) add(fmt::format("scaled {:.4g} \u00d7 {:.4g}", sx, sy));
    return out.empty() ? "almost untransformed" : out;
}

// ---- samplers ----------------------------------------------------------------------------------------

// Range of texture coordinates that the slot reads.
std::pair<glm::dvec2, glm::dvec2> rangeOf(const Primitive& primitive, const TextureSlot& slot) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::vec2& uv : primitive.texcoords[slot.texcoord]) {
        const glm::dvec2 at(slot.u.x * uv.x + slot.u.y * uv.y + slot.u.z,
                            slot.v.x * uv.x + slot.v.y * uv.y + slot.v.z);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    return {low, high};
}

// Whether coordinates exceed [0, 1] by more than rounding, without repeating.
bool isWrapped(Wrap wrap, double low, double high) {
    return wrap != Wrap::repeat && low <= high && (low < -1e-4 || high > 1 + 1e-4);
}
std::string wrapWords(Wrap wrap, const char* axes) {
    return fmt::format("{} beyond its edge along {}",
                       wrap == Wrap::mirrored_repeat ? "mirrored copies" : "stripes of its edge texels",
                       axes);
}

std::string samplingOf(const Scene& scene, const Primitive& primitive, const TextureSlot& slot) {
    const Sampler& sampler = textureOf(scene, slot).sampler;
    std::string out;
    const auto add = [&](const std::string& part) { out += (out.empty() ? "" : ", ") + part; };
    if (sampler.wrap_s != Wrap::repeat || sampler.wrap_t != Wrap::repeat) {
        const auto [low, high] = rangeOf(primitive, slot);
        const bool u = isWrapped(sampler.wrap_s, low.x, high.x), v = isWrapped(sampler.wrap_t, low.y, high.y);
        if (u && v && sampler.wrap_s == sampler.wrap_t) {
            add(wrapWords(sampler.wrap_s, "u and v"));
        } else {
            if (u) add(wrapWords(sampler.wrap_s, "u"));
            if (v) add(wrapWords(sampler.wrap_t, "v"));
        }
    }
    if (!sampler.magnify_linear) add("enlarged texels are sharp squares");
    return out;
}

std::string secondTexcoordOf(const Primitive& primitive, const TextureSlot& slot) {
    if (slot.texcoord != 1) return {};
    return primitive.texcoords[1].empty() ? "one texel everywhere, because TEXCOORD_1 is missing"
                                          : "laid out by TEXCOORD_1";
}

const char* tangentsOf(const Primitive& primitive) {
    return primitive.tangents_made ? "generated tangents" : "the mesh's own tangents";
}

bool isDeep(const Scene& scene, const TextureSlot& slot) {
    return imageOf(scene, slot).deep();
}
std::string colorDepthOf(const Scene& scene, const TextureSlot& slot) {
    return isDeep(scene, slot) ? "more than 8 bits per component" : "";
}

// Integers are scaled to [0, 1]; floats are not scaled.
template <class Texel>
float minAlphaOf(const std::vector<Texel>& rgba) {
    constexpr Texel one = std::is_integral_v<Texel> ? std::numeric_limits<Texel>::max() : Texel{1};
    Texel min = one;
    for (std::size_t i = 3; i < rgba.size(); i += 4) min = std::min(min, rgba[i]);
    return static_cast<float>(min) / static_cast<float>(one);
}
float minAlphaOf(const TextureImage& image) {
    return std::min({minAlphaOf(image.rgba), minAlphaOf(image.rgba16), minAlphaOf(image.rgba32)});
}

// Whether flat shading differs from smooth shading.
bool isBent(const Primitive& primitive) {
    return std::ranges::any_of(primitive.normals,
                               [&](const glm::vec3& n) { return n != primitive.normals.front(); });
}

bool isMirrored(const Instance& instance) {
    return glm::determinant(glm::dmat3(instance.world_from_object)) < 0;
}

}  // namespace

// ---- features ----------------------------------------------------------------------------------------

CheckFeatures featuresOf(const Scene& scene, const std::vector<Material>& materials,
                         const Primitive& primitive) {
    CheckFeatures features = 0;
    const auto add = [&](CheckFeature feature, bool is) {
        if (is) features |= bitOf(feature);
    };
    const Material& m = materialOf(materials, primitive);
    forEachSlot(m, [&](std::size_t, const TextureSlot& slot) {
        add(CheckFeature::texture_transform, isTransformed(slot));
        add(CheckFeature::second_texcoord, slot.texcoord == 1);
        add(CheckFeature::sampler, !samplingOf(scene, primitive, slot).empty());
        add(CheckFeature::deep_image, isDeep(scene, slot));
    });
    add(CheckFeature::orientation, readsSlot(m, gpu::SLOT_base_color) || readsSlot(m, gpu::SLOT_emissive));
    add(CheckFeature::normal_map, readsSlot(m, gpu::SLOT_normal) || readsSlot(m, gpu::SLOT_clearcoat_normal));
    const std::uint32_t layers = layersOf(m);
    add(CheckFeature::clearcoat, (layers & gpu::LAYER_CLEARCOAT) != 0);
    add(CheckFeature::anisotropy, (layers & gpu::LAYER_ANISOTROPY) != 0);
    add(CheckFeature::sheen, (layers & gpu::LAYER_SHEEN) != 0);
    add(CheckFeature::iridescence, (layers & gpu::LAYER_IRIDESCENCE) != 0);
    add(CheckFeature::transmission, (layers & gpu::LAYER_TRANSMISSION) != 0);
    add(CheckFeature::diffuse_transmission, (layers & gpu::LAYER_DIFFUSE_TRANSMISSION) != 0);
    add(CheckFeature::vertex_colors,
        std::ranges::any_of(primitive.colors, [](const glm::vec4& c) { return c != glm::vec4(1); }));
    add(CheckFeature::alpha_mask, m.alpha_mode == AlphaMode::mask);
    add(CheckFeature::blend, m.alpha_mode == AlphaMode::blend);
    add(CheckFeature::double_sided, m.double_sided);
    add(CheckFeature::unlit, m.unlit);
    add(CheckFeature::morph, !primitive.targets.empty());
    add(CheckFeature::flat, primitive.flat && !m.unlit && isBent(primitive));
    return features;
}

CheckFeatures featuresOf(const Scene& scene, const Instance& instance, CheckFeatures features) {
    if (isMirrored(instance)) {
        features |= bitOf(CheckFeature::mirrored);
        features &= ~bitOf(CheckFeature::orientation);  // mirroring may be intended
    }
    if (scene.nodes[static_cast<std::size_t>(instance.node)].skin >= 0 &&
        !primitiveOf(scene, instance).joint_sets.empty())
        features |= bitOf(CheckFeature::skin);
    return features;
}

// ---- descriptions ------------------------------------------------------------------------------------

// Lower bound of the primitive's alpha over all texels and vertices.
float CheckSentences::minAlpha(const Primitive& primitive) {
    const Material& m = materialOf(materials_, primitive);
    float min = m.base_color.a;
    if (!primitive.colors.empty())
        min *= std::ranges::min(primitive.colors, {}, [](const glm::vec4& c) { return c.a; }).a;
    if (!readsSlot(m, gpu::SLOT_base_color)) return min;
    const auto [known, isNew] = min_alpha_.emplace(textureOf(scene_, m.base_color_texture).image, 1.0f);
    if (isNew) known->second = minAlphaOf(imageOf(scene_, m.base_color_texture));
    return min * known->second;
}

std::string CheckSentences::ofMask(const Primitive& primitive) {
    const float cutoff = materialOf(materials_, primitive).alpha_cutoff;
    return minAlpha(primitive) >= cutoff
               ? fmt::format("Masked at {:.3g}, but its alpha is nowhere lower: nothing is cut out.", cutoff)
               : fmt::format(
                     "The cut-out follows the outline in the texture (alpha {:.3g}); the background shows "
                     "through.",
                     cutoff);
}

std::string CheckSentences::ofBlending(const Primitive& primitive) {
    const Material& m = materialOf(materials_, primitive);
    return minAlpha(primitive) >= 1 && !transmits(m)
               ? "Blended, but its alpha is 1 everywhere: nothing behind it shows through."
               : "Transparent: surfaces behind it show through, more where its alpha is lower.";
}

std::string CheckSentences::ofTransmission(const Primitive& primitive) {
    return materialOf(materials_, primitive).thickness > 0
               ? "Opaque surfaces behind it show through, bent as by a lens, blurred where it is rough."
               : "Opaque surfaces behind it show through in place, blurred where it is rough.";
}

std::string CheckSentences::ofMorphTargets(const Instance& instance) {
    const std::string targets = counted(primitiveOf(scene_, instance).targets.size(), "morph target");
    return instance.weights < 0
               ? fmt::format("Its {} have weight 0 at this time: the mesh as modelled.", targets)
               : fmt::format("Deformed by its {}: no vertex is out of place.", targets);
}

std::string CheckSentences::of(const Instance& instance, CheckFeature feature) {
    const Primitive& primitive = primitiveOf(scene_, instance);
    const Material& m = materialOf(materials_, primitive);
    switch (feature) {
        case CheckFeature::texture_transform:
            return bySlot(m, transformOf) +
                   ". Arrows, frames and seams in the texture are in the right place.";
        case CheckFeature::second_texcoord:
            return bySlot(m, [&](const TextureSlot& slot) { return secondTexcoordOf(primitive, slot); }) +
                   ". It fits the surface, neither stretched nor torn.";
        case CheckFeature::sampler:
            return bySlot(m, [&](const TextureSlot& slot) { return samplingOf(scene_, primitive, slot); }) +
                   ".";
        case CheckFeature::normal_map:
            return fmt::format(
                "Bumps rise out of the surface and are lit from the same side as the flat parts beside them "
                "({}).",
                tangentsOf(primitive));
        case CheckFeature::clearcoat:
            return "A clear coat reflects over it: its highlight lies on that of the base and follows the "
                   "coat's own normals and roughness.";
        case CheckFeature::anisotropy:
            return fmt::format("Highlights are stretched along the surface, as on brushed metal ({}).",
                               tangentsOf(primitive));
        case CheckFeature::sheen:
            return "A soft sheen lies over it, brightest towards its outline, as on cloth.";
        case CheckFeature::iridescence:
            return "A thin film tints what it reflects: the colours change with the angle, as on a soap "
                   "bubble.";
        case CheckFeature::transmission:
            return ofTransmission(primitive);
        case CheckFeature::diffuse_transmission:
            return "Light from behind shines through it without an image, as through paper or a leaf.";
        case CheckFeature::vertex_colors:
            return "Vertex colours tint it: gradients are smooth; ticks stand out, crosses do not.";
        case CheckFeature::alpha_mask:
            return ofMask(primitive);
        case CheckFeature::blend:
            return ofBlending(primitive);
        case CheckFeature::double_sided:
            return "It is also visible from behind, lit by the lights on that side.";
        case CheckFeature::mirrored:
            return "Mirrored by its node: its outside is visible, not its inside; bumps and light match its "
                   "neighbours.";
        case CheckFeature::unlit:
            return "Flat colour without shading or highlights, independent of the lights.";
        case CheckFeature::deep_image:
            return bySlot(m, [&](const TextureSlot& slot) { return colorDepthOf(scene_, slot); }) +
                   ". Gradients run without steps.";
        case CheckFeature::skin:
            return "Follows its joints: no vertex is left behind and no part is torn off.";
        case CheckFeature::morph:
            return ofMorphTargets(instance);
        case CheckFeature::flat:
            return "The mesh has no normals: its triangles are flat, with hard edges between them.";
        case CheckFeature::orientation:
            return "The texture is upright and not mirrored: letters are readable.";
    }
    return {};
}

}  // namespace diptych
