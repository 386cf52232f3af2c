// SPDX-License-Identifier: MIT
// A scene's materials on the device, at one time of its animation: one buffer of factors, and a descriptor
// set and Variant per material. Textures are uploaded once for all times; those of one colour as one
// texel.
#pragma once

#include "shared/contract/material.h"
#include "shared/frame/setting_values.h"
#include "shared/material/texel_plan.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <array>
#include <compare>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// The feature bit of each slot's texture, indexed by SLOT_*.
#define DIPTYCH_SLOT_FEATURE(number, name, ...) gpu::FEATURE_##name##_texture,
inline constexpr std::array<gpu::uint, gpu::SLOT_COUNT> slotFeatures{MATERIAL_SLOTS(DIPTYCH_SLOT_FEATURE)};
#undef DIPTYCH_SLOT_FEATURE

class Materials {
public:
    // Uploads every texture that a material ever reads, once per use (sRGB or linear).
    Materials(Device& device, Uploader& uploader, const Scene& scene,
              TexturePrecision precision = TexturePrecision::device);
    // The same materials at another time; `posed` has one per scene material. Shares the textures of
    // `rest`.
    Materials(Device& device, Uploader& uploader, const Materials& rest, const std::vector<Material>& posed);

    // The layout of set(). It is the same for every scene, so sets and pipelines of different scenes are
    // compatible.
    static OwnedDescriptorSetLayout makeLayout(Device& device);
    VkDescriptorSet set(std::uint32_t material) const { return sets_[material]; }
    std::uint32_t count() const { return static_cast<std::uint32_t>(variants_.size()); }

    // Only the features that this material needs.
    const Variant& variant(std::uint32_t material) const { return variants_[material]; }

    // Whether its surfaces are seen through (see blends() of the scene); these cast no shadows.
    bool blends(std::uint32_t material) const { return blends_[material]; }

    std::uint64_t imageBytes() const;  // includes textures that instances share
    std::uint64_t bufferBytes() const { return buffer_.size(); }

    // Textures that are sampled with reduced precision.
    const std::vector<std::string>& notes() const { return textures_->notes; }

private:
    // How a slot reads a texture.
    struct Use {
        int texture = -1;        // into Scene::textures
        bool srgb = false;       // decodes colours from sRGB
        bool one_color = false;  // only the first texel is read
        int alpha_texture = -1;  // its roughness or metallic is in this one's alpha
        std::size_t alpha_component = 0;
        auto operator<=>(const Use&) const = default;
    };
    // The same at all times of an animation.
    struct Textures {
        std::map<Use, std::size_t> image_of;                    // into images
        std::map<int, std::size_t> sampler_of;                  // texture -> index of samplers
        std::map<int, int> image_index;                         // texture -> index of Scene::images
        std::map<std::pair<int, std::size_t>, bool> one_color;  // by texture and readLike()
        // Colours of single-colour textures, by texture and whether sRGB.
        std::map<std::pair<int, bool>, glm::vec4> colors;
        std::vector<GpuImage> images;        // the first is white
        std::vector<OwnedSampler> samplers;  // the first is the default
        std::vector<std::string> notes;

        // `packed`: see TextureQueries.
        SlotTexels texelsOf(const Material& material,
                            const std::function<bool(const Material&)>& packed) const;
        bool hasPacked(const Material& material) const;
        // The use that corresponds to a slot's entry of `texels`.
        Use useOf(const Material& material, const SlotTexels& texels, std::size_t slot) const;
    };
    static std::shared_ptr<const Textures> upload(Device& device, Uploader& uploader, const Scene& scene,
                                                  TexturePrecision precision);
    // Sets image_of; returns the uses of the images, in their order after white.
    static std::vector<Use> chooseImages(const Scene& scene, TexturePrecision precision, Textures& textures);
    static void uploadInUse(Device& device, Uploader& uploader, const Scene& scene,
                            const std::vector<Use>& uses, TexturePrecision precision, Textures& textures);
    static void probeColors(Device& device, const Scene& scene, TexturePrecision precision,
                            Textures& textures);
    void make(Device& device, Uploader& uploader, const std::vector<Material>& materials);

    std::shared_ptr<const Textures> textures_;
    OwnedDescriptorSetLayout layout_;
    GpuBuffer buffer_;
    DescriptorSets sets_;
    std::vector<Variant> variants_;
    std::vector<bool> blends_;
};

}  // namespace diptych
