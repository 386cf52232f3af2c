// SPDX-License-Identifier: MIT
#include "shared/shadow/moments.h"

#include <cmath>
#include <limits>

namespace diptych {

namespace {

constexpr auto momentTypes = bindingTypes({MOMENT_BINDINGS(DIPTYCH_BINDING_ROW)});

enum : std::uint32_t { TO_MOMENTS, ACROSS, DOWN, SETS_OF_LAYER };

}  // namespace

bool hasMoments(Shadows shadows) {
    return shadows == Shadows::evsm || shadows == Shadows::evsm4 || shadows == Shadows::msm4;
}

MomentSupport momentSupport(const Device& device) {
    using namespace format_use;
    const auto can = [&](VkFormat format) {
        return device.support().can(format, sampled | filtered | stored | stored_unnamed);
    };
    return {.filters32 = can(VK_FORMAT_R32G32_SFLOAT) && can(VK_FORMAT_R32G32B32A32_SFLOAT),
            .shares16 = can(VK_FORMAT_R16G16B16A16_UNORM)};
}

namespace {

// Peters and Klein 2015 use 3e-5 for formats more precise than 16 bits. 16-bit floats round moments 64
// times as coarsely as 16-bit integers.
MomentFormat fourMomentFormat(const MomentSupport& device) {
    constexpr double min = 3e-5, of16Bits = 6e-5;
    if (device.shares16) return {VK_FORMAT_R16G16B16A16_UNORM, false, of16Bits, {}};
    const std::string because = "the device cannot store and filter 16-bit UNORM";
    if (device.filters32)
        return {VK_FORMAT_R32G32B32A32_SFLOAT, false, min, "moments in 32-bit floats: " + because};
    return {VK_FORMAT_R16G16B16A16_SFLOAT, true, 64 * of16Bits,
            "moments in 16-bit floats with 64 times the bias: " + because + " or filter 32-bit floats"};
}

}  // namespace

MomentFormat momentFormat(Shadows shadows, EvsmPrecision asked, const MomentSupport& device) {
    if (shadows == Shadows::msm4) return fourMomentFormat(device);
    const bool four = shadows == Shadows::evsm4;
    const MomentFormat single{four ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32G32_SFLOAT, false, 0, {}},
        half{four ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R16G16_SFLOAT, true, 0, {}};
    MomentFormat chosen = asked == EvsmPrecision::fp16 || !device.filters32 ? half : single;
    if (asked != EvsmPrecision::fp16 && !device.filters32)
        chosen.because = "moments in 16-bit floats: the device does not filter 32-bit floats";
    else if (asked == EvsmPrecision::automatic)
        chosen.because = "moments in 32-bit floats: the device filters them";
    return chosen;
}

double largestExponent(bool half) {
    constexpr double largestHalf = 65504;
    return std::log(half ? largestHalf : double{std::numeric_limits<float>::max()}) / 2;
}

MomentMaps::MomentMaps(Device& device)
    : layout_(makeSetLayout(device, momentTypes)),
      sampler_(makeNearestSampler(device)),
      sets_(device, layout_, momentTypes, SETS_OF_LAYER * gpu::MAX_CASCADES) {
    const VkDescriptorSetLayout layout = layout_;
    const VkPushConstantRange constants{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(gpu::MomentConstants)};
    pipeline_layout_ = makePipelineLayout(device, {&layout, 1}, constants);
}

void MomentMaps::record(Pass& pass, const Pipeline& pipeline, std::uint32_t set,
                        const gpu::MomentConstants& constants, VkExtent2D threads) {
    pass.record([this, pipeline, set, constants, threads](VkCommandBuffer commands) {
        const VkDescriptorSet sets = sets_[set];
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_layout_, 0, 1, &sets, 0,
                                nullptr);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdPushConstants(commands, pipeline_layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants,
                           &constants);
        vkCmdDispatch(commands, (threads.width + gpu::MOMENT_THREADS - 1) / gpu::MOMENT_THREADS,
                      threads.height, 1);
    });
}

ImageRef MomentMaps::addPasses(PassList& passes, Pipelines& pipelines, ImageRef depth, std::uint32_t size,
                               std::uint32_t layers, const Request& request) {
    const auto image = [&](const char* name, std::uint32_t count) {
        return passes.image({.name = name,
                             .format = request.format.format,
                             .extent = {size, size},
                             .layers = count,
                             .usage = VK_IMAGE_USAGE_STORAGE_BIT,
                             .array = true,
                             .drawn = false,
                             .filtered = true});
    };
    const ImageRef moments = image("shadow moments", layers);
    const bool blurs = request.variant.get(gpu::FEATURE_shadow_kernel) > 1;
    const ImageRef scratch = blurs ? image("shadow blur", 1) : moments;
    // Views of a single layer, because other layers may be in another layout.
    const auto bind = [&](std::uint32_t set, ImageRef source, const Part& from, VkImageLayout layout,
                          ImageRef target, const Part& to) {
        sets_.image(set, gpu::BINDING_MOMENT_SOURCE, passes.view(source, from), sampler_, layout);
        sets_.image(set, gpu::BINDING_MOMENT_TARGET, passes.view(target, to), VK_NULL_HANDLE,
                    VK_IMAGE_LAYOUT_GENERAL);
    };
    constexpr VkImageLayout sampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const auto dispatch = [&](Pass& pass, Shader shader, std::uint32_t set,
                              const gpu::MomentConstants& constants, VkExtent2D threads) {
        record(pass, pipelines.compute(shader, request.variant, pipeline_layout_), set, constants, threads);
    };
    const std::uint32_t runs = (size + gpu::BLUR_RUN - 1) / gpu::BLUR_RUN;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const Part part{0, 1, layer, 1}, only{0, 1, 0, 1};
        const std::uint32_t sets = SETS_OF_LAYER * layer;
        gpu::MomentConstants constants{.size = size,
                                       .down = 0,
                                       .exponent = request.exponent,
                                       .negative = request.negative,
                                       .nearest = request.nearest};
        bind(sets + TO_MOMENTS, depth, part, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL, moments, part);
        dispatch(passes.compute("shadow moments")
                     .samples(depth, inCompute, part)
                     .uses(moments, access::storageImageWrite(inCompute), part, true),
                 Shader::shadow_moments_comp, sets + TO_MOMENTS, constants, {size, size});
        if (!blurs) continue;
        bind(sets + ACROSS, moments, part, sampled, scratch, only);
        dispatch(passes.compute("shadow blur")
                     .samples(moments, inCompute, part)
                     .uses(scratch, access::storageImageWrite(inCompute), only, true),
                 Shader::shadow_blur_comp, sets + ACROSS, constants, {runs, size});
        bind(sets + DOWN, scratch, only, sampled, moments, part);
        constants.down = 1;
        dispatch(passes.compute("shadow blur")
                     .samples(scratch, inCompute, only)
                     .uses(moments, access::storageImageWrite(inCompute), part, true),
                 Shader::shadow_blur_comp, sets + DOWN, constants, {size, runs});
    }
    return moments;
}

}  // namespace diptych
