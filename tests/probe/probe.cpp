// SPDX-License-Identifier: MIT
#include "tests/probe/probe.h"

#include "shared/vulkan/check.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/resources.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace diptych {

namespace {

constexpr std::uint32_t groupSize = 64;  // local_size_x of every probe

}  // namespace

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
    check(vkCreateShaderModule(device.handle(), &info, nullptr, &module), "vkCreateShaderModule");
    return {device.handle(), module};
}

Probes::Probes() : device_(std::make_unique<Device>(DeviceOptions{})) {}
Probes::~Probes() = default;
Device& Probes::device() {
    return *device_;
}

std::vector<float> Probes::run(const std::string& shader, const std::vector<float>& input,
                               std::size_t inWidth, std::size_t outWidth,
                               std::pair<std::uint32_t, std::uint32_t> feature) {
    Device& device = *device_;
    const std::size_t rows = input.size() / inWidth;
    const auto count = static_cast<std::uint32_t>(rows);
    const OwnedShaderModule module = probeModule(device, shader + ".comp");

    constexpr std::array types{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    const OwnedDescriptorSetLayout layout = makeSetLayout(device, types);
    const std::array<VkDescriptorSetLayout, 1> sets{layout};
    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof count};
    const VkPipelineLayoutCreateInfo layoutInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                .pNext = nullptr,
                                                .flags = 0,
                                                .setLayoutCount = 1,
                                                .pSetLayouts = sets.data(),
                                                .pushConstantRangeCount = 1,
                                                .pPushConstantRanges = &range};
    VkPipelineLayout pipelineLayout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device.handle(), &layoutInfo, nullptr, &pipelineLayout),
          "vkCreatePipelineLayout");
    const OwnedPipelineLayout ownedLayout(device.handle(), pipelineLayout);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    const VkSpecializationMapEntry entry{feature.first, 0, sizeof feature.second};
    const VkSpecializationInfo specialization{1, &entry, sizeof feature.second, &feature.second};
    info.stage.pSpecializationInfo = &specialization;
    info.layout = pipelineLayout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateComputePipelines");
    const OwnedPipeline ownedPipeline(device.handle(), pipeline);

    const GpuBuffer in(device, "in", input.size() * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                       MemoryUse::upload);
    const GpuBuffer out(device, "out", rows * outWidth * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                        MemoryUse::readback);
    std::memcpy(in.mapped(), input.data(), input.size() * sizeof(float));
    DescriptorSets descriptors(device, layout, types, 1);
    descriptors.buffer(0, 0, in.handle());
    descriptors.buffer(0, 1, out.handle());
    device.submit([&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        const VkDescriptorSet set = descriptors[0];
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelineLayout, 0, 1, &set, 0,
                                nullptr);
        vkCmdPushConstants(commands, pipelineLayout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof count, &count);
        vkCmdDispatch(commands, (count + groupSize - 1) / groupSize, 1, 1);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    std::vector<float> result(rows * outWidth);
    std::memcpy(result.data(), out.mapped(), result.size() * sizeof(float));
    return result;
}

}  // namespace diptych
