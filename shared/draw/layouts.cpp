// SPDX-License-Identifier: MIT
#include "shared/draw/layouts.h"

#include "shared/contract/bindings.h"
#include "shared/contract/gbuffer.h"
#include "shared/contract/geometry.h"

#include <array>
#include <cstddef>

namespace diptych {

namespace {

constexpr auto frameTypes = bindingTypes({FRAME_BINDINGS(DIPTYCH_BINDING_ROW)});
constexpr auto partialSumTypes = bindingTypes({PARTIAL_SUM_BINDINGS(DIPTYCH_BINDING_ROW)});
constexpr auto gbufferTypes = bindingTypes(
    {GBUFFER_BINDINGS(DIPTYCH_BINDING_ROW) BindingRow{gpu::BINDING_DEPTH, "DEPTH", binding_kind::image}});

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
      partial_sums_(device, layouts.partial_sums, partialSumTypes, 1),
      gbuffer_(device, layouts.gbuffer, gbufferTypes, 1) {
    constexpr std::array<float, 4> black{};
    for (const GpuImage* const image : {&image_, &array_})
        uploader.level(*image, 0, std::as_bytes(std::span(black)));
    uploader.flush();
    for (DescriptorSets* const sets : {&partial_sums_, &gbuffer_})
        for (gpu::uint i = 0; i < sets->bindings(); ++i)
            sets->image(0, i, image_.view(), layouts.nearest, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace diptych
