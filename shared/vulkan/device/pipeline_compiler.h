// SPDX-License-Identifier: MIT
// Interface through which a drawing device reports its layouts, passes and pipelines to a compiler
// (DeviceCompiler) while it creates its own.
#pragma once

#include "shared/vulkan/instance/device_info.h"

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace diptych {

struct PipelineKey;
struct PipelineParts;
struct ShaderModule;
class Variant;

class PipelineCompiler {
public:
    PipelineCompiler() = default;
    PipelineCompiler(const PipelineCompiler&) = delete;
    PipelineCompiler& operator=(const PipelineCompiler&) = delete;
    virtual ~PipelineCompiler() = default;

    virtual const DeviceInfo& info() const = 0;
    virtual const VkPhysicalDeviceLimits& limits() const = 0;

    virtual void addLayout(VkDescriptorSetLayout of, std::span<const VkDescriptorType> types) = 0;
    virtual void addLayout(VkPipelineLayout of, std::span<const VkDescriptorSetLayout> sets,
                           const std::optional<VkPushConstantRange>& constants) = 0;
    virtual void beginPass(const std::string& name) = 0;
    virtual void ask(VkPipelineLayout layout, const PipelineKey& key,
                     const std::function<PipelineParts(const PipelineKey&)>& choose) = 0;
    virtual void ask(VkPipelineLayout layout, const ShaderModule& kernel, const Variant& variant) = 0;
};

}  // namespace diptych
