// SPDX-License-Identifier: MIT
// Cost of each shadow map filter: bench_shadow_filters [WIDTH HEIGHT [SIZE]]
// Minimum of 15 runs over WIDTH x HEIGHT pixels, minus the same without a filter; and the cost of making
// and blurring the moments of one map of SIZE x SIZE texels.
#include "shared/contract/features.h"
#include "shared/draw/frame_inputs.h"
#include "shared/shadow/moments.h"
#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "tests/probe/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

using namespace diptych;

namespace {

constexpr int runs = 15;

// Minimum time of each pass, by name.
std::map<std::string, double> profiled(PassList& passes) {
    std::map<std::string, std::vector<double>> all;
    passes.run();
    for (int i = 0; i < runs; ++i)
        for (const PassMs& pass : passes.profile(0, passes.size())) all[pass.name].push_back(pass.ms);
    std::map<std::string, double> result;
    for (auto& [name, values] : all) result[name] = std::ranges::min(values);
    return result;
}

OwnedSampler comparing(Device& device) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.compareEnable = VK_TRUE;
    info.compareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
    VkSampler sampler = VK_NULL_HANDLE;
    checkResult(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    return {device.handle(), sampler};
}

constexpr std::array bindings{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                              VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

class Bench {
public:
    Bench(std::uint32_t width, std::uint32_t height, std::uint32_t size)
        : width_(width), height_(height), size_(size), module_(probeModule(device_, "bench_shadow.comp")) {
        const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, 8};
        const VkDescriptorSetLayout set = layout_;
        pipeline_layout_ = makePipelineLayout(device_, {&set, 1}, range);
    }

    // Times of FILTER `filter` of bench_shadow.comp and of its moment passes, by name; ms.
    std::map<std::string, double> of(std::uint32_t filter, Shadows shadows, gpu::uint feature, int kernel) {
        PassList passes(device_, width_, height_);
        const ImageRef depth = passes.image({.name = "map",
                                             .format = depthFormat,
                                             .extent = {size_, size_},
                                             .array = true,
                                             .depths = {.cleared = 0.5f}});
        passes.draw("map").depth(depth, Load::clear).record([](VkCommandBuffer) {});
        MomentMaps::Request request{
            .format = momentFormat(shadows, EvsmPrecision::fp32, momentSupport(device_)), .nearest = -1};
        request.variant.set(gpu::FEATURE_shadows, feature)
            .set(gpu::FEATURE_shadow_kernel, static_cast<gpu::uint>(kernel));
        MomentMaps maps(device_);
        const ImageRef moments = maps.addPasses(passes, pipelines_, depth, size_, 1, request);
        sets_.buffer(0, 0, seen_.handle());
        sets_.image(0, 1, passes.view(depth), comparing_, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
        sets_.image(0, 2, passes.view(moments), linear_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        const OwnedPipeline pipeline = pipelineOf(filter, feature);
        passes.compute("filter")
            .samples(depth, inCompute)
            .samples(moments, inCompute)
            .uses(passes.buffer("seen", seen_), access::storageWrite(inCompute))
            .record([&](VkCommandBuffer commands) {
                const VkDescriptorSet set = sets_[0];
                const std::array<std::uint32_t, 2> size{width_, height_};
                vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
                vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_layout_, 0, 1,
                                        &set, 0, nullptr);
                vkCmdPushConstants(commands, pipeline_layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof size,
                                   size.data());
                vkCmdDispatch(commands, (width_ + 63) / 64, height_, 1);
            });
        return profiled(passes);
    }

private:
    OwnedPipeline pipelineOf(std::uint32_t filter, gpu::uint feature) {
        const std::array<std::uint32_t, 2> values{filter, feature};
        const std::array<VkSpecializationMapEntry, 2> entries{VkSpecializationMapEntry{100, 0, 4},
                                                              {gpu::FEATURE_shadows, 4, 4}};
        const VkSpecializationInfo specialization{2, entries.data(), sizeof values, values.data()};
        VkComputePipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        info.stage.module = module_;
        info.stage.pName = "main";
        info.stage.pSpecializationInfo = &specialization;
        info.layout = pipeline_layout_;
        VkPipeline pipeline = VK_NULL_HANDLE;
        checkResult(vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                    "vkCreateComputePipelines");
        return {device_.handle(), pipeline};
    }

    Device device_{DeviceOptions{}};
    std::uint32_t width_, height_, size_;
    OwnedShaderModule module_;
    OwnedDescriptorSetLayout layout_ = makeSetLayout(device_, bindings);
    OwnedPipelineLayout pipeline_layout_;
    Pipelines pipelines_{device_, VK_NULL_HANDLE};
    GpuBuffer seen_{device_, "seen", std::uint64_t{4} * width_* height_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
    OwnedSampler comparing_ = comparing(device_), linear_ = makeLinearSampler(device_);
    DescriptorSets sets_{device_, layout_, bindings, 1};
};

}  // namespace

int main(int argc, char** argv) {
    const auto number = [&](int i, std::uint32_t otherwise) {
        return argc > i ? static_cast<std::uint32_t>(std::atoi(argv[i])) : otherwise;
    };
    const std::uint32_t width = number(1, 1280), height = number(2, 720), size = number(3, 2048);
    Bench bench(width, height, size);
    const double base = bench.of(0, Shadows::evsm, gpu::SHADOWS_EVSM, 1).at("filter");
    fmt::print("{} x {} pixels, a map of {} x {}; ms beside {:.2f} without a filter\n", width, height, size,
               size, base);
    struct Row {
        const char* name;
        std::uint32_t filter;
        Shadows shadows;
        gpu::uint feature;
    };
    for (const Row& row : {Row{"5 x 5 comparisons", 1, Shadows::evsm, gpu::SHADOWS_EVSM},
                           Row{"16 comparisons by gathers", 2, Shadows::evsm, gpu::SHADOWS_EVSM},
                           Row{"evsm", 3, Shadows::evsm, gpu::SHADOWS_EVSM},
                           Row{"evsm4", 3, Shadows::evsm4, gpu::SHADOWS_EVSM4},
                           Row{"msm4", 3, Shadows::msm4, gpu::SHADOWS_MSM4}}) {
        fmt::print("{:28}{:8.2f}", row.name,
                   bench.of(row.filter, row.shadows, row.feature, 1).at("filter") - base);
        if (row.filter == 3)
            for (const int kernel : {3, 5, 7}) {
                const std::map<std::string, double> passes = bench.of(3, row.shadows, row.feature, kernel);
                fmt::print("   kernel {}: moments {:.1f}, blur {:.1f}", kernel, passes.at("shadow moments"),
                           passes.at("shadow blur"));
            }
        fmt::print("\n");
    }
    return 0;
}
