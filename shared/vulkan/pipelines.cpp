// SPDX-License-Identifier: MIT
#include "shared/vulkan/pipelines.h"

#include "shared/contract/geometry.h"
#include "shared/contract/object_lights.h"
#include "shared/vulkan/check.h"
#include "shared/vulkan/spirv.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstddef>
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

// The least set of inputs (shaders/lib/inputs.glsl) that has what a variant reads. Of the lights of an object
// only those that are shaded at vertices need one.
int inputsOf(const Variant& variant) {
    if ((variant.get(gpu::FEATURE_object_lights) & gpu::OBJECT_LIGHTS_VERTEX) != 0) return 3;
    for (int inputs = 3; inputs > 0; --inputs)
        if (variant.any(featuresNeedingInputs(inputs))) return inputs;
    return 0;
}

// Some shaders exist as several modules, because a device pays for code and inputs that a variant does not
// use: with and without the code of area lights, and with fewer inputs.
std::string moduleOf(const std::string& shader, const Variant& variant) {
    const auto orElse = [](std::string better, std::string plain) {
        return findSpirv(better).empty() ? plain : better;
    };
    std::string module = shader;
    if (variant.get(gpu::FEATURE_area_lights) != 0) module = orElse(module + ".area", module);
    return orElse(fmt::format("{}.inputs{}", module, inputsOf(variant)), module);
}

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
    std::vector<std::pair<const PipelineKey*, OwnedPipeline*>> missing;
    for (const PipelineKey& key : keys) {
        const auto [entry, isNew] = pipelines_.try_emplace(key);
        if (!isNew) continue;
        missing.emplace_back(&entry->first, &entry->second);
        module(moduleOf(key.vertex, key.variant));
        if (!key.fragment.empty()) module(moduleOf(key.fragment, key.variant));
    }
    tbb::parallel_for(std::size_t{0}, missing.size(),
                      [&](std::size_t i) { *missing[i].second = make(*missing[i].first); });
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
    checkResult(vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                "vkCreateComputePipelines");
    entry->second = OwnedPipeline(device_.handle(), pipeline);
    return pipeline;
}

OwnedPipeline Pipelines::make(const PipelineKey& key) const {
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
    addStage(VK_SHADER_STAGE_VERTEX_BIT, moduleOf(key.vertex, key.variant));
    if (!key.fragment.empty()) addStage(VK_SHADER_STAGE_FRAGMENT_BIT, moduleOf(key.fragment, key.variant));

    using Attributes = gpu::VertexAttributes;
    using Draw = gpu::Draw;
    constexpr std::uint32_t perDraw = 2;
    constexpr std::array bindings{
        VkVertexInputBindingDescription{0, sizeof(gpu::vec3), VK_VERTEX_INPUT_RATE_VERTEX},
        VkVertexInputBindingDescription{perDraw, sizeof(Draw), VK_VERTEX_INPUT_RATE_INSTANCE},
        VkVertexInputBindingDescription{1, sizeof(Attributes), VK_VERTEX_INPUT_RATE_VERTEX}};
    constexpr std::uint32_t clip = offsetof(Draw, clip_from_object),
                            world = offsetof(Draw, world_from_object),
                            normal = offsetof(Draw, normal_from_object), column3 = sizeof(gpu::vec3),
                            column4 = sizeof(gpu::vec4);
    static_assert(offsetof(Draw, handedness) == normal + 3 * column3);
    static_assert(offsetof(Attributes, texcoord1) == offsetof(Attributes, texcoord0) + sizeof(gpu::vec2));
    // What a module does not declare is not bound: with the least set of inputs that reads it, -1 always.
    struct Attribute {
        int inputs;
        VkVertexInputAttributeDescription description;
    };
    constexpr VkFormat float3 = VK_FORMAT_R32G32B32_SFLOAT, float4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    constexpr std::array all{Attribute{-1, {0, 0, float3, 0}},
                             Attribute{0, {1, 1, float3, offsetof(Attributes, normal)}},
                             Attribute{2, {2, 1, float4, offsetof(Attributes, tangent)}},
                             Attribute{1, {3, 1, float4, offsetof(Attributes, texcoord0)}},
                             Attribute{3, {4, 1, float4, offsetof(Attributes, color)}},
                             Attribute{-1, {5, perDraw, float4, clip}},
                             Attribute{-1, {6, perDraw, float4, clip + column4}},
                             Attribute{-1, {7, perDraw, float4, clip + 2 * column4}},
                             Attribute{-1, {8, perDraw, float4, clip + 3 * column4}},
                             Attribute{0, {9, perDraw, float3, normal}},
                             Attribute{0, {10, perDraw, float3, normal + column3}},
                             Attribute{0, {11, perDraw, float4, normal + 2 * column3}},
                             Attribute{2, {12, perDraw, float3, world}},
                             Attribute{2, {13, perDraw, float3, world + column3}},
                             Attribute{2, {14, perDraw, float3, world + 2 * column3}},
                             Attribute{2, {15, perDraw, float3, world + 3 * column3}}};
    static_assert(all.size() <= 16);  // what every device has
    const bool none = key.input == VertexInput::none;
    const int inputs = key.input == VertexInput::positions ? -1 : inputsOf(key.variant);
    std::vector<VkVertexInputAttributeDescription> attributes;
    for (const Attribute& attribute : all)
        if (!none && attribute.inputs <= inputs) attributes.push_back(attribute.description);
    const VkPipelineVertexInputStateCreateInfo input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .vertexBindingDescriptionCount = none ? 0u : static_cast<std::uint32_t>(bindings.size()),
        .pVertexBindingDescriptions = bindings.data(),
        .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size()),
        .pVertexAttributeDescriptions = attributes.data()};
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
    checkResult(vkCreateGraphicsPipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                "vkCreateGraphicsPipelines");
    return {device_.handle(), pipeline};
}

}  // namespace diptych
