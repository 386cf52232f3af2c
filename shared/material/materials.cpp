// SPDX-License-Identifier: MIT
#include "shared/material/materials.h"

#include "shared/contract/bindings.h"
#include "shared/contract/material.h"
#include "shared/material/textures.h"
#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_slots.h"

#include <fmt/format.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <array>
#include <cstring>
#include <map>
#include <set>
#include <utility>

namespace diptych {

namespace {

#define DIPTYCH_SLOT_ROW(number, name) BindingRow{number, #name, binding_kind::image},
constexpr auto setTypes = bindingTypes({MATERIAL_SLOTS(DIPTYCH_SLOT_ROW) BindingRow{
    gpu::BINDING_MATERIAL, "MATERIAL", binding_kind::uniform_buffer}});
#undef DIPTYCH_SLOT_ROW

Variant variantOf(const Material& material) {
    Variant variant;
    for (std::size_t slot = 0; slot < materialSlots.size(); ++slot) {
        if (!readsSlot(material, slot)) continue;
        const TextureSlot& texture = material.*materialSlots[slot].texture;
        variant.set(slotFeatures[slot]);
        if (texture.texcoord == 1) variant.set(gpu::FEATURE_second_texcoord);
        if (isTransformed(texture)) variant.set(gpu::FEATURE_texture_transform);
    }
    if (material.alpha_mode == AlphaMode::mask) variant.set(gpu::FEATURE_alpha_mask, gpu::MASK_CUTS);
    if (material.double_sided) variant.set(gpu::FEATURE_double_sided);
    if (material.unlit)
        variant.set(gpu::FEATURE_unlit);
    else if (material.transmission > 0)
        variant.set(gpu::FEATURE_transmission, material.alpha_mode == AlphaMode::blend
                                                   ? gpu::TRANSMISSION_COVERED
                                                   : gpu::TRANSMISSION_WHOLE);
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
    g.lightmap_intensity = m.lightmap_intensity;
    g.transmission = m.transmission;
    for (std::size_t slot = 0; slot < materialSlots.size(); ++slot) {
        const TextureSlot& texture = m.*materialSlots[slot].texture;
        if (texture.texcoord == 1) g.second_texcoord |= 1u << slot;
        g.transforms[slot] = {glm::vec3(texture.u), glm::vec3(texture.v)};
    }
    return g;
}

}  // namespace

OwnedDescriptorSetLayout Materials::makeLayout(Device& device) {
    return makeSetLayout(device, setTypes);
}

Materials::Materials(Device& device, Uploader& uploader, const Scene& scene, TexturePrecision precision)
    : textures_(upload(device, uploader, scene, precision)), layout_(makeLayout(device)) {
    make(device, uploader, scene.materials);
}

Materials::Materials(Device& device, Uploader& uploader, const Materials& rest,
                     const std::vector<Material>& posed)
    : textures_(rest.textures_), layout_(makeLayout(device)) {
    make(device, uploader, posed);
}

void Materials::make(Device& device, Uploader& uploader, const std::vector<Material>& materials) {
    // Each at an offset where a uniform buffer may begin.
    const VkDeviceSize alignment = device.limits().minUniformBufferOffsetAlignment;
    const VkDeviceSize stride = (sizeof(gpu::Material) + alignment - 1) / alignment * alignment;
    std::vector<std::byte> data(materials.size() * stride);
    for (const Material& material : materials) {
        variants_.push_back(variantOf(material));
        blends_.push_back(diptych::blends(material));
        const gpu::Material factors = gpuMaterial(material);
        std::memcpy(&data[(variants_.size() - 1) * stride], &factors, sizeof factors);
    }
    buffer_ = makeBuffer<std::byte>(device, uploader, "materials", data, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);

    sets_ = DescriptorSets(device, layout_, setTypes, count());
    for (std::uint32_t m = 0; m < count(); ++m) {
        sets_.buffer(m, gpu::BINDING_MATERIAL, buffer_.handle(), m * stride, sizeof(gpu::Material));
        for (std::uint32_t slot = 0; slot < materialSlots.size(); ++slot) {
            const int texture = (materials[m].*materialSlots[slot].texture).texture;
            const bool read = readsSlot(materials[m], slot);
            const std::size_t image = read ? textures_->image_of.at({texture, materialSlots[slot].srgb}) : 0;
            const std::size_t sampler = read ? textures_->sampler_of.at(texture) : 0;
            sets_.image(m, slot, textures_->images[image].view(), textures_->samplers[sampler],
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
    }
}

std::shared_ptr<const Materials::Textures> Materials::upload(Device& device, Uploader& uploader,
                                                             const Scene& scene, TexturePrecision precision) {
    // Every image that a slot reads, as sRGB or as linear; slots without a texture use index 0.
    const auto textures = std::make_shared<Textures>();
    std::map<ImageUse, std::size_t> imageOf;
    std::vector<ImageUse> uses;
    std::vector<Sampler> kinds{Sampler{}};
    const auto samplerOf = [&](const Sampler& sampler) {
        for (std::size_t i = 0; i < kinds.size(); ++i)
            if (kinds[i] == sampler) return i;
        kinds.push_back(sampler);
        return kinds.size() - 1;
    };
    const std::set<int> moving = materialsThatMove(scene);
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
        for (std::size_t slot = 0; slot < materialSlots.size(); ++slot) {
            if (!mayReadSlot(scene.materials[m], slot, moving.contains(static_cast<int>(m)))) continue;
            const int texture = (scene.materials[m].*materialSlots[slot].texture).texture;
            const Texture& read = scene.textures[static_cast<std::size_t>(texture)];
            const ImageUse use{read.image, materialSlots[slot].srgb};
            const auto [entry, isNew] = imageOf.try_emplace(use, uses.size() + 1);
            if (isNew) uses.push_back(use);
            textures->image_of[{texture, use.second}] = entry->second;
            textures->sampler_of[texture] = samplerOf(read.sampler);
        }
    textures->images.push_back(uploadTexture(
        device, uploader, MipChain(TextureImage{"white", 1, 1, {255, 255, 255, 255}}, false, Texels::linear8),
        VK_FORMAT_R8G8B8A8_UNORM));
    uploadInUse(device, uploader, scene, uses, precision, *textures);
    for (const Sampler& kind : kinds) textures->samplers.push_back(makeSampler(device, kind));
    return textures;
}

// Chains are made on all cores, as few ahead of the upload as keep them busy: all at once they would take a
// third of the scene's images again.
void Materials::uploadInUse(Device& device, Uploader& uploader, const Scene& scene,
                            const std::vector<ImageUse>& uses, TexturePrecision precision,
                            Textures& textures) {
    std::size_t next = 0, reduced = 0;
    const auto choose = [&](tbb::flow_control& flow) {
        if (next == uses.size()) flow.stop();
        return next++;
    };
    const auto make = [&](std::size_t i) {
        const TextureImage& image = scene.images[static_cast<std::size_t>(uses[i].first)];
        const TextureFormat format = textureFormat(device, image, uses[i].second, precision);
        return std::pair(MipChain(image, uses[i].second, format.texels), format);
    };
    const auto upload = [&](const std::pair<MipChain, TextureFormat>& made) {
        textures.images.push_back(uploadTexture(device, uploader, made.first, made.second.format));
        reduced += !made.second.exact;
    };
    using Made = std::pair<MipChain, TextureFormat>;
    constexpr auto inOrder = tbb::filter_mode::serial_in_order;
    tbb::parallel_pipeline(2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
                           tbb::make_filter<void, std::size_t>(inOrder, choose) &
                               tbb::make_filter<std::size_t, Made>(tbb::filter_mode::parallel, make) &
                               tbb::make_filter<Made, void>(inOrder, upload));
    if (reduced)
        textures.notes.push_back(
            fmt::format("{} texture{} of over 8 bits a component: sampled as half floats (11 bits), {} "
                        "filters nothing wider",
                        reduced, reduced == 1 ? "" : "s", device.info().name));
}

std::uint64_t Materials::imageBytes() const {
    std::uint64_t bytes = 0;
    for (const GpuImage& image : textures_->images) bytes += image.bytes();
    return bytes;
}

}  // namespace diptych
