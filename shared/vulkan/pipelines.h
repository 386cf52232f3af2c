// SPDX-License-Identifier: MIT
// Graphics pipelines by what they are made of; each is compiled once.
#pragma once

#include "shared/vulkan/device.h"
#include "shared/vulkan/variant.h"

#include <compare>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace diptych {

enum class VertexInput { none, positions, all };

struct PipelineKey {
    std::string vertex, fragment;  // files of shaders/pass; no fragment shader: ""
    Variant variant;
    VertexInput input = VertexInput::none;
    std::vector<VkFormat> colors;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;  // always and no write: no depth test
    bool depth_write = false;
    auto operator<=>(const PipelineKey&) const = default;
};

// Triangles; viewport, scissor, cull mode and front face are dynamic.
class Pipelines {
public:
    // `layout` must outlive the pipelines.
    Pipelines(Device& device, VkPipelineLayout layout) : device_(device), layout_(layout) {}

    VkPipeline get(const PipelineKey& key) { return get(std::span(&key, 1)).front(); }
    std::vector<VkPipeline> get(std::span<const PipelineKey> keys);  // new ones are made on all cores
    // A compute shader of shaders/pass, with a layout of its own.
    VkPipeline compute(const std::string& shader, const Variant& variant, VkPipelineLayout layout);
    VkPipelineLayout layout() const { return layout_; }
    std::size_t count() const { return pipelines_.size() + compute_.size(); }

private:
    VkShaderModule module(const std::string& name);
    OwnedPipeline make(const PipelineKey& key) const;  // its modules must be loaded

    Device& device_;
    VkPipelineLayout layout_;
    std::map<std::string, OwnedShaderModule> modules_;
    std::map<PipelineKey, OwnedPipeline> pipelines_;
    std::map<std::pair<std::string, Variant>, OwnedPipeline> compute_;
};

OwnedShaderModule makeShaderModule(Device& device, const std::string& name);

}  // namespace diptych
