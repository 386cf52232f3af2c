// SPDX-License-Identifier: MIT
#include "shared/draw/layouts.h"

#include "shared/contract/bindings.h"
#include "shared/contract/geometry.h"
#include "shared/contract/meshlet_culling.h"

#include <array>
#include <cstddef>
#include <vector>

namespace diptych {

namespace {

constexpr auto frameTypes = bindingTypes({FRAME_BINDINGS(DIPTYCH_BINDING_ROW)});
constexpr auto partialSumTypes = bindingTypes({PARTIAL_SUM_BINDINGS(DIPTYCH_BINDING_ROW)});
constexpr auto gbufferTypes = bindingTypes({GBUFFER_SET_BINDINGS(DIPTYCH_BINDING_ROW)});

}  // namespace

std::span<const VkDescriptorType> frameBindings() {
    return frameTypes;
}
std::span<const VkDescriptorType> gbufferBindings() {
    return gbufferTypes;
}
std::span<const VkDescriptorType> partialSumBindings() {
    return partialSumTypes;
}

Layouts::Layouts(Device& device, VkDescriptorSetLayout material)
    : frame(makeSetLayout(device, frameTypes)),
      gbuffer(makeSetLayout(device, gbufferTypes)),
      partial_sums(makeSetLayout(device, partialSumTypes)) {
    const std::array<VkDescriptorSetLayout, 4> sets{frame, material, gbuffer, partial_sums};
    pipeline =
        makePipelineLayout(device, sets, VkPushConstantRange{drawStages, 0, sizeof(gpu::DrawConstants)});
    culling = makePipelineLayout(
        device, {}, VkPushConstantRange{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(gpu::CullingConstants)});
    nearest = makeNearestSampler(device);
    lists = ListLayouts(device, frame);
}

Placeholders::Placeholders(Device& device, Uploader& uploader, const Layouts& layouts)
    : image_(device, {"black texel", VK_FORMAT_R32G32B32A32_SFLOAT, 1, 1, 1,
                      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT}),
      array_(device, {.name = "black texel of an array",
                      .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                      .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                      .array = true}),
      nearest_(makeNearestSampler(device)),
      partial_sums_(device, layouts.partial_sums, partialSumTypes, 1),
      gbuffer_(device, layouts.gbuffer, gbufferTypes, 1) {
    constexpr std::array<float, 4> black{};
    for (const GpuImage* const image : {&image_, &array_})
        uploader.level(*image, 0, std::as_bytes(std::span(black)));
    texels_ = makeBuffer<glm::vec4>(device, uploader, "black texels", std::vector<glm::vec4>(1),
                                    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    uploader.flush();
    texels_view_ = makeTexelView(device, "black texels", texels_, VK_FORMAT_R32G32B32A32_SFLOAT);
    for (gpu::uint i = 0; i < partial_sums_.bindings(); ++i)
        partial_sums_.image(0, i, image_.view(), layouts.nearest, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    storage_ = GpuBuffer(device, "no fragments", 16, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    bindGBuffer(gbuffer_, layouts);
}

void Placeholders::bindGBuffer(DescriptorSets& gbuffer, const Layouts& layouts) const {
    for (gpu::uint i = 0; i < gbuffer.bindings(); ++i) {
        if (gbufferTypes[i] == binding_kind::storage_buffer)
            gbuffer.buffer(0, i, storage_.handle());
        else if (gbufferTypes[i] == binding_kind::fetched_image)  // storage images: only shaders that use
                                                                  // them declare them
            gbuffer.image(0, i, image_.view(), layouts.nearest, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
}

void Placeholders::bindFrame(DescriptorSets& frame) const {
    for (const gpu::uint binding : {gpu::BINDING_SHADOW_LIGHT, gpu::BINDING_LOCAL_SHADOW_LIGHTS,
                                    gpu::BINDING_ENVIRONMENT, gpu::BINDING_HAZE})
        frame.texels(0, binding, texels_view_);
    for (const gpu::uint binding : {gpu::BINDING_SHADOW_MAP, gpu::BINDING_LOCAL_SHADOW_MAP})
        frame.image(0, binding, array_.view(), nearest_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    for (const gpu::uint binding : {gpu::BINDING_ENVIRONMENT_MAPS, gpu::BINDING_SKY})
        frame.image(0, binding, image_.view(), nearest_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace diptych
