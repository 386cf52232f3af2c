// SPDX-License-Identifier: MIT
#include "shared/vulkan/pipelines.h"

#include "shared/vulkan/check.h"
#include "shared/vulkan/spirv.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

namespace diptych {

namespace {

// A variant's values as specialization constants; it must outlive this.
struct Specialization {
    explicit Specialization(const Variant& variant) {
        for (std::uint32_t id = 0; id < gpu::FEATURE_COUNT; ++id) entries[id] = {id, id * 4, 4};
        info = {gpu::FEATURE_COUNT, entries.data(), sizeof variant.values(), variant.values().data()};
    }
    std::array<VkSpecializationMapEntry, gpu::FEATURE_COUNT> entries;
    VkSpecializationInfo info;
};

}  // namespace

OwnedShaderModule makeShaderModule(Device& device, const std::string& name) {
    const auto words = findSpirv(name);
    if (words.empty()) throw std::logic_error("no shader " + name + " in shaders/pass");
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .pNext = nullptr,
                                        .flags = 0,
                                        .codeSize = words.size_bytes(),
                                        .pCode = words.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    checkResult(vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule");
    return {device.handle(), module};
}

VkShaderModule Pipelines::module(const std::string& name) {
    const auto found = modules_.find(name);
    if (found != modules_.end()) return found->second;
    return modules_.emplace(name, makeShaderModule(device_, name)).first->second;
}

std::vector<VkPipeline> Pipelines::get(std::span<const PipelineKey> keys) {
    struct Missing {
        const PipelineKey* key;
        PipelineParts parts;
        OwnedPipeline* pipeline;
    };
    std::vector<Missing> missing;
    for (const PipelineKey& key : keys) {
        const auto [entry, isNew] = pipelines_.try_emplace(key);
        if (!isNew) continue;
        missing.push_back({&entry->first,
                           choose_ ? choose_(key) : PipelineParts{key.vertex, key.fragment, {}, {}},
                           &entry->second});
        module(missing.back().parts.vertex);
        if (!key.fragment.empty()) module(missing.back().parts.fragment);
    }
    tbb::parallel_for(std::size_t{0}, missing.size(),
                      [&](std::size_t i) { *missing[i].pipeline = make(*missing[i].key, missing[i].parts); });
    std::vector<VkPipeline> pipelines;
    for (const PipelineKey& key : keys) pipelines.push_back(pipelines_.at(key));
    return pipelines;
}

VkPipeline Pipelines::compute(const std::string& shader, const Variant& variant, VkPipelineLayout layout) {
    const auto [entry, isNew] = compute_.try_emplace({shader, variant});
    if (!isNew) return entry->second;
    const Specialization specialization(variant);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module(shader);
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization.info;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkResult(
        vkCreateComputePipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines");
    entry->second = OwnedPipeline(device_.handle(), pipeline);
    return pipeline;
}

void Pipelines::clear() {
    pipelines_.clear();
    compute_.clear();
}

OwnedPipeline Pipelines::make(const PipelineKey& key, const PipelineParts& parts) const {
    const Specialization specialization(key.variant);
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    const auto addStage = [&](VkShaderStageFlagBits stage, const std::string& name) {
        stages.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                          .pNext = nullptr,
                          .flags = 0,
                          .stage = stage,
                          .module = modules_.at(name),
                          .pName = "main",
                          .pSpecializationInfo = &specialization.info});
    };
    addStage(VK_SHADER_STAGE_VERTEX_BIT, parts.vertex);
    if (!parts.fragment.empty()) addStage(VK_SHADER_STAGE_FRAGMENT_BIT, parts.fragment);

    const VkPipelineVertexInputStateCreateInfo input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .vertexBindingDescriptionCount = static_cast<std::uint32_t>(parts.bindings.size()),
        .pVertexBindingDescriptions = parts.bindings.data(),
        .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(parts.attributes.size()),
        .pVertexAttributeDescriptions = parts.attributes.data()};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
        .primitiveRestartEnable = VK_FALSE};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .viewportCount = 1,
        .pViewports = nullptr,
        .scissorCount = 1,
        .pScissors = nullptr};
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = key.depth_compare != VK_COMPARE_OP_ALWAYS || key.depth_write;
    depth.depthWriteEnable = key.depth_write;
    depth.depthCompareOp = key.depth_compare;
    VkPipelineColorBlendAttachmentState opaque{};
    opaque.colorWriteMask = 0xf;
    const std::vector<VkPipelineColorBlendAttachmentState> blends(key.colors.size(), opaque);
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
    blend.pAttachments = blends.data();
    constexpr std::array dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                 VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE};
    const VkPipelineDynamicStateCreateInfo dynamics{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .dynamicStateCount = dynamic.size(),
        .pDynamicStates = dynamic.data()};
    const VkPipelineRenderingCreateInfo rendering{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .pNext = nullptr,
        .viewMask = 0,
        .colorAttachmentCount = static_cast<std::uint32_t>(key.colors.size()),
        .pColorAttachmentFormats = key.colors.data(),
        .depthAttachmentFormat = key.depth,
        .stencilAttachmentFormat = VK_FORMAT_UNDEFINED};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .flags = 0,
                                            .stageCount = static_cast<std::uint32_t>(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &assembly,
                                            .pTessellationState = nullptr,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamics,
                                            .layout = layout_,
                                            .renderPass = VK_NULL_HANDLE,
                                            .subpass = 0,
                                            .basePipelineHandle = VK_NULL_HANDLE,
                                            .basePipelineIndex = 0};
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkResult(
        vkCreateGraphicsPipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
    return {device_.handle(), pipeline};
}

}  // namespace diptych
