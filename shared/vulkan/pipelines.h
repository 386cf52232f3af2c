// SPDX-License-Identifier: MIT
// Graphics pipelines by what they are made of; each is compiled once.
#pragma once

#include "shared/vulkan/device.h"
#include "shared/vulkan/variant.h"

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

struct PipelineKey {
    std::string vertex, fragment;  // files of shaders/pass; no fragment shader: ""
    Variant variant;
    std::uint32_t input = 0;  // a vertex format of whoever chooses the parts; 0: none
    std::vector<VkFormat> colors;
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;  // always and no write: no depth test
    bool depth_write = false;
    auto operator<=>(const PipelineKey&) const = default;
};

// What a key leaves to whoever knows the shaders and the vertices: the embedded modules that serve its
// shaders in its variant, and where vertices come from.
struct PipelineParts {
    std::string vertex, fragment;
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;
};
using ChooseParts = std::function<PipelineParts(const PipelineKey&)>;

// Triangles; viewport, scissor, cull mode and front face are dynamic.
class Pipelines {
public:
    // `layout` must outlive the pipelines. Without `choose` shaders are their modules, and there are no
    // vertices.
    Pipelines(Device& device, VkPipelineLayout layout, ChooseParts choose = {})
        : device_(device), layout_(layout), choose_(std::move(choose)) {}

    VkPipeline get(const PipelineKey& key) { return get(std::span(&key, 1)).front(); }
    std::vector<VkPipeline> get(std::span<const PipelineKey> keys);  // new ones are made on all cores
    // A compute shader of shaders/pass, with a layout of its own.
    VkPipeline compute(const std::string& shader, const Variant& variant, VkPipelineLayout layout);
    VkPipelineLayout layout() const { return layout_; }
    // Destroys all, of which none may be in use: a driver may hold megabytes for each.
    void clear();
    std::size_t count() const { return pipelines_.size() + compute_.size(); }

private:
    VkShaderModule module(const std::string& name);
    OwnedPipeline make(const PipelineKey& key,
                       const PipelineParts& parts) const;  // its modules must be loaded

    Device& device_;
    VkPipelineLayout layout_;
    ChooseParts choose_;
    std::map<std::string, OwnedShaderModule> modules_;
    std::map<PipelineKey, OwnedPipeline> pipelines_;
    std::map<std::pair<std::string, Variant>, OwnedPipeline> compute_;
};

OwnedShaderModule makeShaderModule(Device& device, const std::string& name);

}  // namespace diptych
