// SPDX-License-Identifier: MIT
#include "shared/material/materials.h"

#include "shared/contract/material.h"
#include "shared/scene/material_slots.h"
#include "shared/scene/mipmap.h"
#include "shared/vulkan/check.h"

#include <tbb/parallel_for.h>

#include <array>
#include <map>
#include <span>
#include <utility>

namespace diptych {

namespace {

constexpr std::array<VkDescriptorType, gpu::SLOT_COUNT> slotTypes = [] {
    std::array<VkDescriptorType, gpu::SLOT_COUNT> types{};
    types.fill(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    return types;
}();

// The feature that reads each slot.
constexpr std::array<gpu::uint, gpu::SLOT_COUNT> slotFeatures{
    gpu::FEATURE_base_color_texture,    gpu::FEATURE_metallic_roughness_texture,
    gpu::FEATURE_normal_texture,        gpu::FEATURE_occlusion_texture,
    gpu::FEATURE_emissive_texture,      gpu::FEATURE_specular_texture,
    gpu::FEATURE_specular_color_texture};

Variant variantOf(const Material& material) {
    Variant variant;
    for (std::size_t slot = 0; slot < materialSlots.size(); ++slot) {
        if (!readsSlot(material, slot)) continue;
        const TextureSlot& texture = material.*materialSlots[slot].texture;
        variant.set(slotFeatures[slot]);
        if (texture.texcoord == 1) variant.set(gpu::FEATURE_second_texcoord);
        if (isTransformed(texture)) variant.set(gpu::FEATURE_texture_transform);
    }
    if (material.alpha_mode == AlphaMode::mask) variant.set(gpu::FEATURE_alpha_mask);
    if (material.double_sided) variant.set(gpu::FEATURE_double_sided);
    if (material.unlit) variant.set(gpu::FEATURE_unlit);
    return variant;
}

gpu::Material gpuMaterial(const Material& m) {
    gpu::Material g{};
    g.base_color = m.base_color;
    g.emission = m.emissive;
    g.metallic = m.metallic;
    const float r = (1 - m.ior) / (1 + m.ior);  // KHR_materials_ior
    g.dielectric_f0 = r * r * m.specular_color;
    g.roughness = m.roughness;
    g.specular = m.specular;
    g.normal_scale = m.normal_scale;
    g.occlusion_strength = m.occlusion_strength;
    g.alpha_cutoff = m.alpha_cutoff;
    for (std::size_t slot = 0; slot < materialSlots.size(); ++slot) {
        const TextureSlot& texture = m.*materialSlots[slot].texture;
        if (texture.texcoord == 1) g.second_texcoord |= 1u << slot;
        g.transforms[slot] = {glm::vec3(texture.u), glm::vec3(texture.v)};
    }
    return g;
}

OwnedSampler makeSampler(Device& device, const Sampler& s) {
    const auto address = [](Wrap wrap) {
        return wrap == Wrap::repeat            ? VK_SAMPLER_ADDRESS_MODE_REPEAT
               : wrap == Wrap::mirrored_repeat ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
                                               : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    };
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = s.magnify_linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.minFilter = s.minify_linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.mipmapMode = s.mipmaps_linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = address(s.wrap_s);
    info.addressModeV = address(s.wrap_t);
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    // Vulkan's mapping of OpenGL's filters without mip levels: a clamp just above level 0 keeps the choice
    // between magnification and minification.
    info.maxLod = s.mipmaps ? VK_LOD_CLAMP_NONE : 0.25f;
    VkSampler sampler = VK_NULL_HANDLE;
    check(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    return {device.handle(), sampler};
}

GpuImage uploadImage(Device& device, Uploader& uploader, const std::vector<TextureImage>& levels, bool srgb) {
    GpuImage image(device,
                   {levels[0].name, srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM,
                    static_cast<std::uint32_t>(levels[0].width), static_cast<std::uint32_t>(levels[0].height),
                    static_cast<std::uint32_t>(levels.size()),
                    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    for (std::uint32_t level = 0; level < levels.size(); ++level)
        uploader.level(image, level, std::as_bytes(std::span(levels[level].rgba)));
    return image;
}

}  // namespace

Materials::Materials(Device& device, Uploader& uploader, const Scene& scene)
    : layout_(makeSetLayout(device, slotTypes)) {
    // Every image that a slot reads, as sRGB or as linear; index 0 stands in for slots without a texture.
    using ImageUse = std::pair<int, bool>;
    std::map<ImageUse, std::size_t> imageOf;
    std::vector<ImageUse> uses;
    std::vector<Sampler> kinds{Sampler{}};
    const auto samplerOf = [&](const Sampler& sampler) {
        for (std::size_t i = 0; i < kinds.size(); ++i)
            if (kinds[i] == sampler) return i;
        kinds.push_back(sampler);
        return kinds.size() - 1;
    };
    const auto imageUse = [&](const TextureSlot& slot, bool srgb) {
        const ImageUse use{scene.textures[static_cast<std::size_t>(slot.texture)].image, srgb};
        const auto [entry, isNew] = imageOf.try_emplace(use, uses.size() + 1);
        if (isNew) uses.push_back(use);
        return entry->second;
    };

    std::vector<gpu::Material> data;
    for (const Material& material : scene.materials) {
        variants_.push_back(variantOf(material));
        data.push_back(gpuMaterial(material));
        for (std::size_t slot = 0; slot < materialSlots.size(); ++slot)
            if (readsSlot(material, slot))
                imageUse(material.*materialSlots[slot].texture, materialSlots[slot].srgb);
    }
    buffer_ =
        makeBuffer<gpu::Material>(device, uploader, "materials", data, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);

    std::vector<std::vector<TextureImage>> chains(uses.size());
    tbb::parallel_for(std::size_t{0}, uses.size(), [&](std::size_t i) {
        chains[i] = makeMipmaps(scene.images[static_cast<std::size_t>(uses[i].first)], uses[i].second);
    });
    images_.push_back(
        uploadImage(device, uploader, {TextureImage{"white", 1, 1, {255, 255, 255, 255}}}, false));
    for (std::size_t i = 0; i < uses.size(); ++i) {
        images_.push_back(uploadImage(device, uploader, chains[i], uses[i].second));
        chains[i].clear();
    }

    sets_ = DescriptorSets(device, layout_, slotTypes, count());
    for (std::uint32_t m = 0; m < count(); ++m)
        for (std::uint32_t slot = 0; slot < materialSlots.size(); ++slot) {
            const TextureSlot& texture = scene.materials[m].*materialSlots[slot].texture;
            const bool read = readsSlot(scene.materials[m], slot);
            const std::size_t image = read ? imageUse(texture, materialSlots[slot].srgb) : 0;
            const std::size_t sampler =
                read ? samplerOf(scene.textures[static_cast<std::size_t>(texture.texture)].sampler) : 0;
            while (samplers_.size() < kinds.size())
                samplers_.push_back(makeSampler(device, kinds[samplers_.size()]));
            sets_.image(m, slot, images_[image].view(), samplers_[sampler],
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
}

std::uint64_t Materials::imageBytes() const {
    std::uint64_t bytes = 0;
    for (const GpuImage& image : images_) bytes += image.bytes();
    return bytes;
}

}  // namespace diptych
