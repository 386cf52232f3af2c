// SPDX-License-Identifier: MIT
#include "compare/probe/device_rows.h"

#include "compare/probe/modules.h"
#include "shared/vulkan/check.h"
#include "shared/vulkan/resources.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace diptych::probe {
namespace {

constexpr std::uint32_t row_group = 64;            // local_size_x of rows.glsl
constexpr std::uint32_t function_constant = 1000;  // of rows.glsl
constexpr std::array row_bindings{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

OwnedShaderModule moduleOf(Device& device, const std::string& name) {
    for (const ShaderModule& module : probe::shaderModules()) {
        if (module.name != name) continue;
        const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                            .pNext = nullptr,
                                            .flags = 0,
                                            .codeSize = module.words.size_bytes(),
                                            .pCode = module.words.data()};
        VkShaderModule made = VK_NULL_HANDLE;
        checkResult(vkCreateShaderModule(device.handle(), &info, nullptr, &made), "vkCreateShaderModule");
        return {device.handle(), made};
    }
    throw std::logic_error("no shader of probes is called " + name);
}

}  // namespace

DeviceRows::DeviceRows(Device& device) : device_(device), set_(makeSetLayout(device, row_bindings)) {
    const std::array<VkDescriptorSetLayout, 1> sets{set_};
    layout_ = makePipelineLayout(
        device, sets, VkPushConstantRange{VK_SHADER_STAGE_COMPUTE_BIT, 0, 3 * sizeof(std::uint32_t)});
}

OwnedPipeline DeviceRows::pipelineOf(const Probe& probe) {
    const OwnedShaderModule module = moduleOf(device_, probe.shader);
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    const auto specialise = [&](std::uint32_t id, std::uint32_t value) {
        entries.push_back({id, static_cast<std::uint32_t>(values.size() * sizeof(value)), sizeof(value)});
        values.push_back(value);
    };
    specialise(function_constant, probe.function);
    for (const auto& [id, value] : probe.features) specialise(id, value);
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              values.size() * sizeof values[0], values.data()};
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialization;
    info.layout = layout_;
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkResult(
        vkCreateComputePipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines");
    return {device_.handle(), pipeline};
}

std::vector<float> DeviceRows::run(const Probe& probe, const std::vector<float>& in) {
    const std::size_t rows = in.size() / probe.ins;
    std::vector<float> out(rows * probe.outs);
    if (probe.shader.empty()) {
        for (std::size_t i = 0; i < rows; ++i) probe.host(&in[i * probe.ins], &out[i * probe.outs]);
        return out;
    }
    const OwnedPipeline pipeline = pipelineOf(probe);
    const GpuBuffer from(device_, "probe inputs", in.size() * sizeof(float),
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::upload);
    const GpuBuffer to(device_, "probe outputs", out.size() * sizeof(float),
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::readback);
    std::memcpy(from.mapped(), in.data(), in.size() * sizeof(float));
    DescriptorSets descriptors(device_, set_, row_bindings, 1);
    descriptors.buffer(0, 0, from.handle());
    descriptors.buffer(0, 1, to.handle());
    const std::array widths{static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(probe.ins),
                            static_cast<std::uint32_t>(probe.outs)};
    device_.submit(
        [&](VkCommandBuffer commands) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
            const VkDescriptorSet set = descriptors[0];
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set, 0,
                                    nullptr);
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof widths,
                               widths.data());
            vkCmdDispatch(commands, (widths[0] + row_group - 1) / row_group, 1, 1);
            memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                          VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                          VK_ACCESS_2_HOST_READ_BIT);
        },
        "the probe " + probe.name);
    std::memcpy(out.data(), to.mapped(), out.size() * sizeof(float));
    return out;
}

}  // namespace diptych::probe
