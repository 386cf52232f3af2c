// SPDX-License-Identifier: MIT
#include "shared/material/materials.h"

#include "shared/contract/bindings.h"
#include "shared/contract/material.h"
#include "shared/material/texture_probe.h"
#include "shared/material/textures.h"
#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_slots.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <utility>

namespace diptych {

namespace {

#define DIPTYCH_SLOT_ROW(number, name, ...) BindingRow{number, #name, binding_kind::image},
constexpr auto setTypes = bindingTypes({MATERIAL_SLOTS(DIPTYCH_SLOT_ROW) BindingRow{
    gpu::BINDING_MATERIAL, "MATERIAL", binding_kind::uniform_buffer}});
#undef DIPTYCH_SLOT_ROW

Variant variantOf(const Material& material, const SlotTexels& texels) {
    Variant variant;
    for (std::size_t slot = 0; slot < materialSlots.size(); ++slot) {
        if (texels[slot] == 0) continue;
        const TextureSlot& texture = slotOf(material, slot);
        variant.set(slotFeatures[slot], texels[slot]);
        if (texels[slot] != gpu::TEXEL_OWN) continue;  // has no coordinates of its own
        if (texture.texcoord == 1) variant.set(gpu::FEATURE_second_texcoord);
        if (isTransformed(texture)) variant.set(gpu::FEATURE_texture_transform);
    }
    if (material.alpha_mode == AlphaMode::mask) variant.set(gpu::FEATURE_alpha_mask, gpu::MASK_CUTS);
    if (material.double_sided) variant.set(gpu::FEATURE_double_sided);
    if (material.specular_glossiness) variant.set(gpu::FEATURE_specular_glossiness);
    if (material.unlit)
        variant.set(gpu::FEATURE_unlit);
    else if (material.transmission > 0)
        variant.set(gpu::FEATURE_transmission, material.alpha_mode == AlphaMode::blend
                                                   ? gpu::TRANSMISSION_COVERED
                                                   : gpu::TRANSMISSION_WHOLE);
    if (diffusesThroughVolume(material)) variant.set(gpu::FEATURE_absorbing);
    variant.set(gpu::FEATURE_layers, layersOf(material) & ~gpu::LAYER_TRANSMISSION);
    variant.set(gpu::FEATURE_turned_maps,
                rotatedMaps(material, material.anisotropy > 0).layers & layersOf(material));
    return variant;
}

gpu::Material gpuMaterial(const Material& m) {
    gpu::Material g{};
#define DIPTYCH_COPY(type, name, ...) g.name = m.name;
    MATERIAL_FACTORS(DIPTYCH_COPY)
#undef DIPTYCH_COPY
    g.emission = m.emissive;
    const float r = (1 - m.ior) / (1 + m.ior);  // KHR_materials_ior
    g.dielectric_f0 = r * r * m.specular_color;
    g.anisotropy_rotation = {std::cos(m.anisotropy_rotation), std::sin(m.anisotropy_rotation)};
    for (std::size_t slot = 0; slot < materialSlots.size(); ++slot) {
        const TextureSlot& texture = slotOf(m, slot);
        if (texture.texcoord == 1) g.second_texcoord |= 1u << slot;
        g.transforms[slot] = {glm::vec3(texture.u), glm::vec3(texture.v)};
    }
    return g;
}

// Calls `use` with every material and slot that reads a texture, and whether the material is animated.
template <class Take>
void eachRead(const Scene& scene, const Take& use) {
    const std::set<int> moving = materialsThatMove(scene);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const bool moves = moving.contains(static_cast<int>(m));
        for (std::size_t slot = 0; slot < materialSlots.size(); ++slot)
            if (mayReadSlot(scene.materials[m], slot, moves)) use(scene.materials[m], slot, moves);
    }
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
    // Offsets are aligned for uniform buffers.
    const VkDeviceSize alignment = device.limits().minUniformBufferOffsetAlignment;
    const VkDeviceSize stride = (sizeof(gpu::Material) + alignment - 1) / alignment * alignment;
    std::vector<std::byte> data(materials.size() * stride);
    std::vector<SlotTexels> texels;
    for (const Material& material : materials) {
        texels.push_back(
            textures_->texelsOf(material, [&](const Material& m) { return textures_->hasPacked(m); }));
        variants_.push_back(variantOf(material, texels.back()));
        blends_.push_back(diptych::blends(material));
        gpu::Material factors = gpuMaterial(material);
        for (std::size_t slot = 0; slot < materialSlots.size(); ++slot)
            if (texels.back()[slot] == gpu::TEXEL_CONSTANT)
                factors.texels[slot] =
                    textures_->colors.at({slotOf(material, slot).texture, materialSlots[slot].srgb});
        std::memcpy(&data[(variants_.size() - 1) * stride], &factors, sizeof factors);
    }
    buffer_ = makeBuffer<std::byte>(device, uploader, "materials", data, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);

    sets_ = DescriptorSets(device, layout_, setTypes, count());
    for (std::uint32_t m = 0; m < count(); ++m) {
        sets_.buffer(m, gpu::BINDING_MATERIAL, buffer_.handle(), m * stride, sizeof(gpu::Material));
        for (std::uint32_t slot = 0; slot < materialSlots.size(); ++slot) {
            const bool bound = texels[m][slot] != 0 && texels[m][slot] != gpu::TEXEL_ALPHAS;
            const Use use = bound ? textures_->useOf(materials[m], texels[m], slot) : Use{};
            const std::size_t image = bound ? textures_->image_of.at(use) : 0;
            const std::size_t sampler = bound ? textures_->sampler_of.at(use.texture) : 0;
            sets_.image(m, slot, textures_->images[image].view(), textures_->samplers[sampler],
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
    }
}

SlotTexels Materials::Textures::texelsOf(const Material& material,
                                         const std::function<bool(const Material&)>& packed) const {
    return slotTexels(material, {[&](int texture, std::size_t slot) {
                                     return one_color.at({texture, slot});
                                 },
                                 [&](int a, int b) {
                                     return image_index.at(a) == image_index.at(b) &&
                                            sampler_of.at(a) == sampler_of.at(b);
                                 },
                                 packed});
}

bool Materials::Textures::hasPacked(const Material& material) const {
    SlotTexels texels{};
    texels[gpu::SLOT_metallic_roughness] = gpu::TEXEL_ALPHAS;
    return image_of.contains(useOf(material, texels, gpu::SLOT_base_color)) &&
           image_of.contains(useOf(material, texels, gpu::SLOT_normal));
}

Materials::Use Materials::Textures::useOf(const Material& material, const SlotTexels& texels,
                                          std::size_t slot) const {
    Use use{slotOf(material, slot).texture, materialSlots[slot].srgb, texels[slot] == gpu::TEXEL_CONSTANT};
    constexpr std::size_t green = 1, blue = 2;
    if (texels[gpu::SLOT_metallic_roughness] == gpu::TEXEL_ALPHAS &&
        (slot == gpu::SLOT_base_color || slot == gpu::SLOT_normal)) {
        use.alpha_texture = material.metallic_roughness_texture.texture;
        use.alpha_component = slot == gpu::SLOT_normal ? green : blue;
    }
    return use;
}

std::shared_ptr<const Materials::Textures> Materials::upload(Device& device, Uploader& uploader,
                                                             const Scene& scene, TexturePrecision precision) {
    // Every image that a slot reads, as sRGB or linear; slots without a texture use index 0.
    const auto textures = std::make_shared<Textures>();
    std::vector<Sampler> kinds{Sampler{}};
    const auto samplerOf = [&](const Sampler& sampler) {
        for (std::size_t i = 0; i < kinds.size(); ++i)
            if (kinds[i] == sampler) return i;
        kinds.push_back(sampler);
        return kinds.size() - 1;
    };
    std::map<std::pair<int, std::size_t>, bool> oneColor;  // by image and readLike()
    eachRead(scene, [&](const Material& material, std::size_t slot, bool) {
        const int texture = slotOf(material, slot).texture;
        const Texture& read = textureOf(scene, slotOf(material, slot));
        const std::size_t like = readLike(material, slot);
        const auto [known, isNew] = oneColor.try_emplace({read.image, like});
        if (isNew) known->second = hasOneColor(scene.images[static_cast<std::size_t>(read.image)], like);
        textures->one_color[{texture, like}] = known->second;
        textures->image_index[texture] = read.image;
        textures->sampler_of[texture] = samplerOf(read.sampler);
    });
    const std::vector<Use> uses = chooseImages(scene, precision, *textures);
    textures->images.push_back(uploadTexture(
        device, uploader, MipChain(TextureImage{"white", 1, 1, {255, 255, 255, 255}}, false, Texels::linear8),
        VK_FORMAT_R8G8B8A8_UNORM));
    uploadInUse(device, uploader, scene, uses, precision, *textures);
    probeColors(device, scene, precision, *textures);
    for (const Sampler& kind : kinds) textures->samplers.push_back(makeSampler(device, kind));
    return textures;
}

std::vector<Materials::Use> Materials::chooseImages(const Scene& scene, TexturePrecision precision,
                                                    Textures& textures) {
    std::map<Use, std::size_t> imageOf;  // keyed by the image's first texture with this use
    std::vector<Use> uses;
    // Image -> its first texture, because textures of one image differ only in samplers.
    std::map<int, int> firstOf;
    const auto first = [&](int texture) {
        return firstOf.try_emplace(textures.image_index.at(texture), texture).first->second;
    };
    const auto upload = [&](const Use& use) {
        // A magnified alpha depends on its texture's wrap mode.
        Use same = use;
        same.texture = first(use.texture);
        const auto [entry, isNew] = imageOf.try_emplace(same, uses.size() + 1);
        if (isNew) uses.push_back(same);
        textures.image_of[use] = entry->second;
    };
    eachRead(scene, [&](const Material& material, std::size_t slot, bool moves) {
        const int texture = slotOf(material, slot).texture;
        SlotTexels texels{};
        if (textures.one_color.at({texture, readLike(material, slot)})) texels[slot] = gpu::TEXEL_CONSTANT;
        if (precision == TexturePrecision::packed && !moves) {
            const SlotTexels planned =
                textures.texelsOf(material, [&](const Material& m) { return isPacked(m, scene); });
            if (planned[gpu::SLOT_metallic_roughness] == gpu::TEXEL_ALPHAS) texels = planned;
        }
        if (texels[slot] != gpu::TEXEL_ALPHAS) upload(textures.useOf(material, texels, slot));
    });
    return uses;
}

// Decodes colours on the device, so that a factor has the bits of a sample.
void Materials::probeColors(Device& device, const Scene& scene, TexturePrecision precision,
                            Textures& textures) {
    for (const bool srgb : {false, true}) {
        std::vector<int> of;
        std::vector<std::array<std::uint8_t, 4>> colors;
        for (const auto& [use, image] : textures.image_of) {
            if (!use.one_color || use.srgb != srgb) continue;
            of.push_back(use.texture);
            const auto& rgba =
                scene.images[static_cast<std::size_t>(textures.image_index.at(use.texture))].rgba;
            colors.push_back({rgba[0], rgba[1], rgba[2], rgba[3]});
        }
        if (colors.empty()) continue;
        const std::vector<glm::vec4> found = diptych::probeColors(device, colors, srgb, precision);
        for (std::size_t i = 0; i < of.size(); ++i) textures.colors[{of[i], srgb}] = found[i];
    }
}

// Chains are built on all cores, only as far ahead of the upload as keeps them busy. Building all at once
// would take another third of the images' memory.
void Materials::uploadInUse(Device& device, Uploader& uploader, const Scene& scene,
                            const std::vector<Use>& uses, TexturePrecision precision, Textures& textures) {
    const auto imageOf = [&](int texture) -> const TextureImage& {
        return scene.images[static_cast<std::size_t>(textures.image_index.at(texture))];
    };
    std::size_t next = 0, reduced = 0;
    const auto choose = [&](tbb::flow_control& flow) {
        if (next == uses.size()) flow.stop();
        return next++;
    };
    const auto make = [&](std::size_t i) {
        const Use& use = uses[i];
        const TextureImage& image = imageOf(use.texture);
        const TextureFormat format = textureFormat(device, image, use.srgb, precision);
        if (use.one_color) {
            const TextureImage texel{image.name, 1, 1, {image.rgba.begin(), image.rgba.begin() + 4}};
            MipChain chain(texel, use.srgb, format.texels);
            chain.own();
            return std::pair(std::move(chain), format);
        }
        MipChain chain(image, use.srgb, format.texels);
        if (use.alpha_texture >= 0) {
            const Sampler& sampler = scene.textures[static_cast<std::size_t>(use.alpha_texture)].sampler;
            chain.replaceAlpha(MipChain(imageOf(use.alpha_texture), false, Texels::linear8),
                               use.alpha_component, sampler.wrap_s == Wrap::repeat,
                               sampler.wrap_t == Wrap::repeat);
        }
        return std::pair(std::move(chain), format);
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
            fmt::format("{} with over 8 bits per component: sampled as half floats (11 bits), the widest "
                        "format that {} filters",
                        counted(reduced, "texture"), device.info().name));
}

std::uint64_t Materials::imageBytes() const {
    std::uint64_t bytes = 0;
    for (const GpuImage& image : textures_->images) bytes += image.bytes();
    return bytes;
}

}  // namespace diptych
