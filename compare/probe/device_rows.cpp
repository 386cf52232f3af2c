// SPDX-License-Identifier: MIT
#include "compare/probe/device_rows.h"

#include "compare/probe/modules.h"
#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace diptych::probe {
namespace {

constexpr std::uint32_t row_group = 64;            // local_size_x of rows.glsl
constexpr std::uint32_t function_constant = 1000;  // constant_id of rows.glsl
constexpr std::array row_bindings{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

const ShaderModule& moduleOf(const std::string& name) {
    for (const ShaderModule& module : probe::shaderModules())
        if (module.name == name) return module;
    throw std::logic_error("no shader of probes is called " + name);
}

// Specialization constants that the probe does not set are 0.
SpecializationValue valueOf(const Probe& probe) {
    return [&probe](std::uint32_t id) {
        if (id == function_constant) return probe.function;
        const auto found =
            std::ranges::find(probe.features, id, &std::pair<std::uint32_t, std::uint32_t>::first);
        return found == probe.features.end() ? 0u : found->second;
    };
}

}  // namespace

DeviceRows::DeviceRows(Device& device) : device_(device), set_(makeSetLayout(device, row_bindings)) {
    const std::array<VkDescriptorSetLayout, 1> sets{set_};
    layout_ = makePipelineLayout(
        device, sets, VkPushConstantRange{VK_SHADER_STAGE_COMPUTE_BIT, 0, 3 * sizeof(std::uint32_t)});
}

std::vector<float> DeviceRows::run(const Probe& probe, const std::vector<float>& in) {
    const std::size_t rows = in.size() / probe.ins;
    std::vector<float> out(rows * probe.outs);
    if (probe.shader.empty()) {
        for (std::size_t i = 0; i < rows; ++i) probe.host(&in[i * probe.ins], &out[i * probe.outs]);
        return out;
    }
    const OwnedPipeline pipeline =
        makePipeline(contextOf(device_, layout_), moduleOf(probe.shader), valueOf(probe));
    const GpuBuffer from(device_, "probe inputs", in.size() * sizeof(float),
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::upload);
    const GpuBuffer to(device_, "probe outputs", out.size() * sizeof(float),
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::readback);
    std::memcpy(from.mapped(), in.data(), in.size() * sizeof(float));
    std::memset(to.mapped(), 0xff, out.size() * sizeof(float));  // NaN where the shader writes nothing
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
