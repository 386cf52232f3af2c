// SPDX-License-Identifier: MIT
// A scene's materials on the device, at rest or as animations have moved them: one buffer of factors, one
// descriptor set and one Variant each. Textures are uploaded once for all times.
#pragma once

#include "shared/contract/material.h"
#include "shared/frame/setting_values.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/pipelines.h"
#include "shared/vulkan/resources.h"

#include <array>
#include <cstddef>
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
    // What no animation changes.
    struct Textures {
        using Use = std::pair<int, bool>;       // into Scene::textures; whether its colours are sRGB
        std::map<Use, std::size_t> image_of;    // into images
        std::map<int, std::size_t> sampler_of;  // texture -> into samplers
        std::vector<GpuImage> images;           // the first is white
        std::vector<OwnedSampler> samplers;     // the first is the default one
        std::vector<std::string> notes;
    };
    using ImageUse = std::pair<int, bool>;  // into Scene::images; whether its colours are sRGB
    static std::shared_ptr<const Textures> upload(Device& device, Uploader& uploader, const Scene& scene,
                                                  TexturePrecision precision);
    static void uploadInUse(Device& device, Uploader& uploader, const Scene& scene,
                            const std::vector<ImageUse>& uses, TexturePrecision precision,
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
