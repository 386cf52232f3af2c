// SPDX-License-Identifier: MIT
#include "tests/probe/probe.h"

#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

namespace diptych {

OwnedShaderModule probeModule(Device& device, const std::string& shader) {
    const std::filesystem::path file = std::filesystem::path(DIPTYCH_PROBE_DIR) / (shader + ".spv");
    std::vector<std::uint32_t> words(std::filesystem::file_size(file) / 4);
    std::ifstream(file, std::ios::binary)
        .read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .pNext = nullptr,
                                        .flags = 0,
                                        .codeSize = words.size() * 4,
                                        .pCode = words.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    checkResult(vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule");
    return {device.handle(), module};
}

Device& probeDevice() {
    static Device device{DeviceOptions{}};
    return device;
}

namespace {

constexpr std::uint32_t groupSize = 64;  // local_size_x of every probe
constexpr std::array probeBindings{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

// Common to all probes: set 0 contains input and output, the push constant is the number of rows.
struct ProbeLayout {
    explicit ProbeLayout(Device& device) : set(makeSetLayout(device, probeBindings)) {
        const std::array<VkDescriptorSetLayout, 1> sets{set};
        const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(std::uint32_t)};
        pipeline = makePipelineLayout(device, sets, range);
    }
    OwnedDescriptorSetLayout set;
    OwnedPipelineLayout pipeline;
};

using Feature = std::pair<std::uint32_t, std::uint32_t>;

OwnedPipeline makeProbe(Device& device, VkPipelineLayout layout, const std::string& shader,
                        const std::vector<Feature>& features) {
    const OwnedShaderModule module = probeModule(device, shader + ".comp");
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    for (const auto& [id, value] : features) {
        entries.push_back({id, static_cast<std::uint32_t>(values.size() * sizeof value), sizeof value});
        values.push_back(value);
    }
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                              values.size() * sizeof values[0], values.data()};
    info.stage.pSpecializationInfo = &specialization;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkResult(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                "vkCreateComputePipelines");
    return {device.handle(), pipeline};
}

}  // namespace

std::vector<float> Probes::run(const std::string& shader, const std::vector<float>& input,
                               std::size_t inWidth, std::size_t outWidth,
                               const std::vector<Feature>& features) {
    Device& device = probeDevice();
    const std::size_t rows = input.size() / inWidth;
    const auto count = static_cast<std::uint32_t>(rows);
    // Compiles each shader once for all tests.
    static const ProbeLayout layout(device);
    static std::map<std::pair<std::string, std::vector<Feature>>, OwnedPipeline> pipelines;
    OwnedPipeline& pipeline = pipelines[{shader, features}];
    if (pipeline == VK_NULL_HANDLE) pipeline = makeProbe(device, layout.pipeline, shader, features);

    const GpuBuffer in(device, "in", input.size() * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                       MemoryUse::upload);
    const GpuBuffer out(device, "out", rows * outWidth * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                        MemoryUse::readback);
    std::memcpy(in.mapped(), input.data(), input.size() * sizeof(float));
    DescriptorSets descriptors(device, layout.set, probeBindings, 1);
    descriptors.buffer(0, 0, in.handle());
    descriptors.buffer(0, 1, out.handle());
    device.submit([&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        const VkDescriptorSet set = descriptors[0];
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout.pipeline, 0, 1, &set, 0,
                                nullptr);
        vkCmdPushConstants(commands, layout.pipeline, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof count, &count);
        vkCmdDispatch(commands, (count + groupSize - 1) / groupSize, 1, 1);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    std::vector<float> result(rows * outWidth);
    std::memcpy(result.data(), out.mapped(), result.size() * sizeof(float));
    return result;
}

}  // namespace diptych
