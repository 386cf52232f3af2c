// SPDX-License-Identifier: MIT
#include "shared/vulkan/pipelines/pipelines.h"

#include "shared/vulkan/device/pipeline_compiler.h"
#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/spirv/flatten.h"
#include "shared/vulkan/spirv/shader_interface.h"
#include "shared/vulkan/spirv/specialize.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace diptych {

namespace {

[[noreturn]] void refuse(const CreationContext& context, std::string_view what, const std::string& why) {
    throw std::runtime_error(
        fmt::format("device {} ({}): {}: {}", context.info.index, context.info.name, what, why));
}

// Throws if the device does not support the pipeline.
void checkPipeline(const CreationContext& context, const PipelineKey& key, const PipelineParts& parts) {
    const std::string_view name = parts.fragment != nullptr ? parts.fragment->name : parts.vertex->name;
    const auto needs = [&](VkFormat format, std::uint32_t uses) {
        if (const auto lacks = context.support.lacks(format, uses)) refuse(context, name, *lacks);
    };
    const auto blendOf = [&](std::size_t i) { return key.blends.empty() ? Blend::none : key.blends.at(i); };
    for (std::size_t i = 0; i < key.colors.size(); ++i) {
        needs(key.colors[i], blendOf(i) == Blend::none ? std::uint32_t{format_use::drawn}
                                                       : format_use::drawn | format_use::blended);
        if (blendOf(i) != blendOf(0) && !context.support.has(DeviceFeature::independentBlend))
            refuse(context, name, "it lacks independent blending; choose another device with --device");
    }
    if (key.depth != VK_FORMAT_UNDEFINED) needs(key.depth, format_use::depth);
    for (const VkVertexInputAttributeDescription& attribute : parts.attributes)
        needs(attribute.format, format_use::vertices);
}

// Reduces the module to the variant. `outputs`: locations that the next stage reads.
std::vector<std::uint32_t> specializedWords(const CreationContext& context, const ShaderModule& module,
                                            const SpecializationValue& value,
                                            const std::optional<std::set<std::uint32_t>>& outputs = {}) {
    auto words = specialized(module.words, value, outputs);
    if (const auto problem = moduleProblem(context.support, words))
        refuse(context, module.name, *problem + ", which it lacks; choose another device with --device");
    return context.flattens_branches ? flattened(words) : words;
}

OwnedShaderModule makeModule(const CreationContext& context, std::span<const std::uint32_t> words) {
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .pNext = nullptr,
                                        .flags = 0,
                                        .codeSize = words.size() * sizeof(std::uint32_t),
                                        .pCode = words.data()};
    VkShaderModule handle = VK_NULL_HANDLE;
    checkResult(vkCreateShaderModule(context.device, &info, nullptr, &handle), "vkCreateShaderModule");
    return {context.device, handle};
}

VkPipelineShaderStageCreateInfo stageOf(VkShaderStageFlagBits stage, VkShaderModule module) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .pNext = nullptr,
            .flags = 0,
            .stage = stage,
            .module = module,
            .pName = "main",
            .pSpecializationInfo = nullptr};
}

// States that are the same for every pipeline.
constexpr VkPipelineInputAssemblyStateCreateInfo triangleAssembly{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
    .pNext = nullptr,
    .flags = 0,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    .primitiveRestartEnable = VK_FALSE};
constexpr VkPipelineViewportStateCreateInfo oneViewport{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
    .pNext = nullptr,
    .flags = 0,
    .viewportCount = 1,
    .pViewports = nullptr,
    .scissorCount = 1,
    .pScissors = nullptr};
constexpr std::array dynamicStates{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                   VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE};
constexpr VkPipelineDynamicStateCreateInfo dynamicState{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
    .pNext = nullptr,
    .flags = 0,
    .dynamicStateCount = dynamicStates.size(),
    .pDynamicStates = dynamicStates.data()};

VkPipelineRasterizationStateCreateInfo rasterState(const PipelineKey& key) {
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.depthBiasEnable = key.depth_bias != DepthBias{};
    raster.depthBiasConstantFactor = key.depth_bias.constant;
    raster.depthBiasSlopeFactor = key.depth_bias.slope;
    raster.lineWidth = 1.0f;
    return raster;
}

VkPipelineMultisampleStateCreateInfo sampleState(const PipelineKey& key) {
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = key.samples;
    samples.sampleShadingEnable = key.sample_shading;
    samples.minSampleShading = 1;
    return samples;
}

VkPipelineDepthStencilStateCreateInfo depthState(const PipelineKey& key) {
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = key.depth_compare != VK_COMPARE_OP_ALWAYS || key.depth_write;
    depth.depthWriteEnable = key.depth_write;
    depth.depthCompareOp = key.depth_compare;
    return depth;
}

VkPipelineColorBlendAttachmentState blendState(Blend blend) {
    struct Factors {
        VkBlendFactor source, there, source_alpha, alpha_there;
    };
    constexpr VkBlendFactor one = VK_BLEND_FACTOR_ONE, zero = VK_BLEND_FACTOR_ZERO;
    const auto factors = [&]() -> Factors {
        switch (blend) {
            case Blend::none:
                break;
            case Blend::add:
                return {one, one, one, one};
            case Blend::over:
                return {one, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA, one, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA};
            case Blend::multiply:
                return {zero, VK_BLEND_FACTOR_SRC_COLOR, zero, VK_BLEND_FACTOR_SRC_ALPHA};
            case Blend::through:
                return {one, VK_BLEND_FACTOR_SRC_ALPHA, zero, one};
        }
        return {one, zero, one, zero};
    }();
    VkPipelineColorBlendAttachmentState state{};
    state.colorWriteMask = 0xf;
    state.blendEnable = blend != Blend::none;
    state.srcColorBlendFactor = factors.source;
    state.dstColorBlendFactor = factors.there;
    state.srcAlphaBlendFactor = factors.source_alpha;
    state.dstAlphaBlendFactor = factors.alpha_there;
    return state;
}

std::vector<VkPipelineColorBlendAttachmentState> blendStates(const PipelineKey& key) {
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    for (std::size_t i = 0; i < key.colors.size(); ++i)
        blends.push_back(blendState(key.blends.empty() ? Blend::none : key.blends.at(i)));
    return blends;
}

// Attributes that the variant does not read are not fetched.
std::vector<VkVertexInputAttributeDescription> fetchedBy(
    std::span<const std::uint32_t> vertex, std::vector<VkVertexInputAttributeDescription> attributes) {
    std::erase_if(attributes, [read = inputLocations(vertex)](const VkVertexInputAttributeDescription& a) {
        return !read.contains(a.location);
    });
    return attributes;
}

VkPipelineRenderingCreateInfo attachmentFormats(const PipelineKey& key) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
            .pNext = nullptr,
            .viewMask = 0,
            .colorAttachmentCount = static_cast<std::uint32_t>(key.colors.size()),
            .pColorAttachmentFormats = key.colors.data(),
            .depthAttachmentFormat = key.depth,
            .stencilAttachmentFormat = VK_FORMAT_UNDEFINED};
}

}  // namespace

PipelineParts plainParts(const PipelineKey& key) {
    return {&shaderModule(key.vertex),
            key.fragment == Shader::none ? nullptr : &shaderModule(key.fragment),
            {},
            {}};
}

CreationContext contextOf(Device& device, VkPipelineLayout layout) {
    return {.device = device.handle(),
            .support = device.support(),
            .info = device.info(),
            .layout = layout,
            .cache = device.pipelineCache(),
            .flattens_branches = device.profile().flattens_branches};
}

SpecializationValue valueOf(const Variant& variant) {
    return [variant](std::uint32_t id) { return variant.get(id); };
}

namespace {

// Modules of a pipeline's stages, reduced to its variant: vertex and, if there is one, fragment; or compute.
using StageCode = std::vector<std::vector<std::uint32_t>>;

StageCode codeOf(const CreationContext& context, const PipelineKey& key, const PipelineParts& parts) {
    checkPipeline(context, key, parts);
    const SpecializationValue value = valueOf(key.variant);
    if (parts.fragment == nullptr)
        return {specializedWords(context, *parts.vertex, value, inputLocations({}))};
    std::vector<std::uint32_t> fragment = specializedWords(context, *parts.fragment, value);
    return {specializedWords(context, *parts.vertex, value, inputLocations(fragment)), std::move(fragment)};
}

StageCode codeOf(const CreationContext& context, const ShaderModule& module,
                 const SpecializationValue& value) {
    return {specializedWords(context, module, value)};
}

OwnedPipeline makePipeline(const CreationContext& context, const PipelineKey& key, const PipelineParts& parts,
                           const StageCode& code) {
    std::vector<OwnedShaderModule> modules;
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    for (const std::vector<std::uint32_t>& words : code) {
        modules.push_back(makeModule(context, words));
        stages.push_back(stageOf(stages.empty() ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT,
                                 modules.back()));
    }
    const std::vector<VkVertexInputAttributeDescription> attributes =
        fetchedBy(code.front(), parts.attributes);
    const VkPipelineVertexInputStateCreateInfo input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .vertexBindingDescriptionCount = static_cast<std::uint32_t>(parts.bindings.size()),
        .pVertexBindingDescriptions = parts.bindings.data(),
        .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size()),
        .pVertexAttributeDescriptions = attributes.data()};
    const VkPipelineRasterizationStateCreateInfo raster = rasterState(key);
    const VkPipelineMultisampleStateCreateInfo samples = sampleState(key);
    const VkPipelineDepthStencilStateCreateInfo depth = depthState(key);
    const std::vector<VkPipelineColorBlendAttachmentState> blends = blendStates(key);
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
    blend.pAttachments = blends.data();
    const VkPipelineRenderingCreateInfo rendering = attachmentFormats(key);
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .flags = context.flags,
                                            .stageCount = static_cast<std::uint32_t>(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &triangleAssembly,
                                            .pTessellationState = nullptr,
                                            .pViewportState = &oneViewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamicState,
                                            .layout = context.layout,
                                            .renderPass = VK_NULL_HANDLE,
                                            .subpass = 0,
                                            .basePipelineHandle = VK_NULL_HANDLE,
                                            .basePipelineIndex = 0};
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkResult(vkCreateGraphicsPipelines(context.device, context.cache, 1, &info, nullptr, &pipeline),
                "vkCreateGraphicsPipelines");
    return {context.device, pipeline};
}

OwnedPipeline makePipeline(const CreationContext& context, const StageCode& code) {
    const OwnedShaderModule module = makeModule(context, code.front());
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.flags = context.flags | VK_PIPELINE_CREATE_DISPATCH_BASE_BIT;
    info.stage = stageOf(VK_SHADER_STAGE_COMPUTE_BIT, module);
    info.layout = context.layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkResult(vkCreateComputePipelines(context.device, context.cache, 1, &info, nullptr, &pipeline),
                "vkCreateComputePipelines");
    return {context.device, pipeline};
}

}  // namespace

OwnedPipeline makePipeline(const CreationContext& context, const PipelineKey& key,
                           const PipelineParts& parts) {
    return makePipeline(context, key, parts, codeOf(context, key, parts));
}

OwnedPipeline makePipeline(const CreationContext& context, const ShaderModule& module,
                           const SpecializationValue& value) {
    return makePipeline(context, codeOf(context, module, value));
}

struct Pipeline::State {
    std::function<StageCode()> code;  // throws what the device does not support
    std::function<OwnedPipeline(const StageCode&)> make;
    OwnedPipeline made{};
    std::uint64_t code_bytes = 0;
    std::uint64_t asked = 0;  // order of the latest request

    VkPipeline handle() {
        if (made == VK_NULL_HANDLE) {
            const StageCode words = code();
            for (const auto& stage : words) code_bytes += stage.size() * sizeof(std::uint32_t);
            made = make(words);
        }
        return made;
    }
};

Pipeline::operator VkPipeline() const& {
    return state_->handle();
}

std::vector<Pipeline> Pipelines::get(std::span<const PipelineKey> keys) {
    const CreationContext context = contextOf(device_, layout_);
    if (PipelineCompiler* const compiler = device_.compiler())
        for (const PipelineKey& key : keys) compiler->ask(layout_, key, choose_);
    std::vector<Pipeline> pipelines, added;
    for (const PipelineKey& key : keys) {
        const auto [pipeline, isNew] = find(key);
        pipelines.push_back(pipeline);
        if (!isNew) continue;
        added.push_back(pipeline);
        pipeline.state_->code = [=, choose = choose_] { return codeOf(context, key, choose(key)); };
        pipeline.state_->make = [=, choose = choose_](const StageCode& code) {
            return makePipeline(context, key, choose(key), code);
        };
    }
    create(added);
    return pipelines;
}

Pipeline Pipelines::compute(const ShaderModule& module, const Variant& variant, VkPipelineLayout layout) {
    if (PipelineCompiler* const compiler = device_.compiler()) compiler->ask(layout, module, variant);
    const auto [pipeline, isNew] = find(std::pair(&module, variant));
    if (!isNew) return pipeline;
    const CreationContext context = contextOf(device_, layout);
    pipeline.state_->code = [context, &module, variant] { return codeOf(context, module, valueOf(variant)); };
    pipeline.state_->make = [context](const StageCode& code) { return makePipeline(context, code); };
    create(std::span(&pipeline, 1));
    return pipeline;
}

std::pair<Pipeline, bool> Pipelines::find(const Key& key) {
    const auto [entry, isNew] = pipelines_.try_emplace(key);
    if (isNew) entry->second.state_ = std::make_shared<Pipeline::State>();
    entry->second.state_->asked = ++asked_;
    return {entry->second, isNew};
}

void Pipelines::create(std::span<const Pipeline> added) {
    if (added.empty()) return;
    made_ += added.size();
    try {
        tbb::parallel_for(std::size_t{0}, added.size(), [&](std::size_t i) {
            if (creation_ == Creation::planned)
                added[i].state_->code();
            else
                added[i].state_->handle();
        });
    } catch (...) {
        // Pipelines that were not created must not be found later.
        std::erase_if(pipelines_,
                      [&](const auto& entry) { return std::ranges::count(added, entry.second) > 0; });
        throw;
    }
    releaseUnused();
}

// lavapipe keeps several translations of a shader: measured for specialised modules of 1 to 80 KB.
std::uint64_t Pipelines::bytesOf(const Pipeline& pipeline) const {
    const std::uint64_t code = pipeline.state_->code_bytes;
    return device_.profile().software ? (std::uint64_t{1} << 20) + 70 * code : code;
}

std::uint64_t Pipelines::bytes(bool inUse) const {
    std::uint64_t sum = 0;
    for (const auto& [key, pipeline] : pipelines_)
        if (isUsed(pipeline) == inUse) sum += bytesOf(pipeline);
    return sum;
}

void Pipelines::releaseUnused() {
    std::uint64_t unused = bytes(false);
    while (unused > maxUnused) {
        auto oldest = pipelines_.end();
        for (auto entry = pipelines_.begin(); entry != pipelines_.end(); ++entry)
            if (!isUsed(entry->second) &&
                (oldest == pipelines_.end() || entry->second.state_->asked < oldest->second.state_->asked))
                oldest = entry;
        unused -= bytesOf(oldest->second);
        pipelines_.erase(oldest);
    }
}

void Pipelines::erase(const std::function<bool(const PipelineKey&)>& which) {
    std::erase_if(pipelines_, [&](const auto& entry) {
        const auto* const key = std::get_if<PipelineKey>(&entry.first);
        return key != nullptr && which(*key);
    });
}

}  // namespace diptych
