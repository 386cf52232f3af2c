// SPDX-License-Identifier: MIT
// A scene's materials on the device, at rest or as animations have moved them: one buffer of factors, one
// descriptor set and one Variant each. Textures are uploaded once for all times, of one colour as one texel.
#pragma once

#include "shared/contract/material.h"
#include "shared/frame/setting_values.h"
#include "shared/material/texel_plan.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/pipelines.h"
#include "shared/vulkan/resources.h"

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

// The feature that says that a slot has a texture, indexed by SLOT_*.
#define DIPTYCH_SLOT_FEATURE(number, name) gpu::FEATURE_##name##_texture,
inline constexpr std::array<gpu::uint, gpu::SLOT_COUNT> slotFeatures{MATERIAL_SLOTS(DIPTYCH_SLOT_FEATURE)};
#undef DIPTYCH_SLOT_FEATURE

class Materials {
public:
    // Uploads every texture that a material reads at any time, once for each way it is read (sRGB or linear).
    Materials(Device& device, Uploader& uploader, const Scene& scene,
              TexturePrecision precision = TexturePrecision::device);
    // The same materials at another time, as many as the scene has, with the textures of `rest`.
    Materials(Device& device, Uploader& uploader, const Materials& rest, const std::vector<Material>& posed);

    // What set() is allocated with: the same for every scene, so that sets of any fit pipelines made with it.
    static OwnedDescriptorSetLayout makeLayout(Device& device);
    VkDescriptorSet set(std::uint32_t material) const { return sets_[material]; }
    std::uint32_t count() const { return static_cast<std::uint32_t>(variants_.size()); }

    // The features that this material needs, all others off.
    const Variant& variant(std::uint32_t material) const { return variants_[material]; }

    // Whether its surfaces are blended over what lies behind them (blends() of the scene). Those throw no
    // shadow.
    bool blends(std::uint32_t material) const { return blends_[material]; }

    std::uint64_t imageBytes() const;  // of what both constructors share too
    std::uint64_t bufferBytes() const { return buffer_.size(); }

    const std::vector<std::string>& notes() const {
        return textures_->notes;
    }  // what is sampled with fewer bits

private:
    // A texture as a slot reads it.
    struct Use {
        int texture = -1;        // into Scene::textures
        bool srgb = false;       // of its colours
        bool one_color = false;  // its first texel alone
        int alpha_texture = -1;  // whose texels, roughness and metallic, are in its alpha
        std::size_t alpha_component = 0;
        auto operator<=>(const Use&) const = default;
    };
    // What no animation changes.
    struct Textures {
        std::map<Use, std::size_t> image_of;                    // into images
        std::map<int, std::size_t> sampler_of;                  // texture -> into samplers
        std::map<int, int> image_number;                        // texture -> into Scene::images
        std::map<std::pair<int, std::size_t>, bool> one_color;  // texture and slot
        std::map<std::pair<int, bool>, glm::vec4> colors;       // of textures of one colour, by whether sRGB
        std::vector<GpuImage> images;                           // the first is white
        std::vector<OwnedSampler> samplers;                     // the first is the default one
        std::vector<std::string> notes;

        // `packed` as TextureQuestions has it.
        SlotTexels texelsOf(const Material& material,
                            const std::function<bool(const Material&)>& packed) const;
        bool hasPacked(const Material& material) const;
        // Where texels says that it is on the device.
        Use useOf(const Material& material, const SlotTexels& texels, std::size_t slot) const;
    };
    static std::shared_ptr<const Textures> upload(Device& device, Uploader& uploader, const Scene& scene,
                                                  TexturePrecision precision);
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
