// SPDX-License-Identifier: MIT
// Graphics pipelines by what they are made of; each is compiled once.
#pragma once

#include "shared/vulkan/device.h"
#include "shared/vulkan/specialize.h"
#include "shared/vulkan/spirv.h"
#include "shared/vulkan/variant.h"

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace diptych {

// How a colour s with coverage or opacity s.a joins what the attachment holds, d; alpha follows the same
// rule.
enum class Blend : std::uint8_t {
    none,      // s
    add,       // s + d
    over,      // s + (1 - s.a) d: s is premultiplied
    multiply,  // s d
    through,   // s + s.a d: s.a is what comes through s; alpha stays d.a
};

// Added to the depth of every fragment: `constant` units of the depth format's least step at that depth, and
// `slope` times the largest change of depth from pixel to pixel. Depth is reversed: negative is farther away.
struct DepthBias {
    float constant = 0, slope = 0;
    auto operator<=>(const DepthBias&) const = default;
};

struct PipelineKey {
    Shader vertex = Shader::none, fragment = Shader::none;  // no fragment shader: none
    Variant variant{};
    std::uint32_t input = 0;  // a vertex format of whoever chooses the parts; 0: none
    std::vector<VkFormat> colors{};
    std::vector<Blend> blends{};  // of each colour; empty: none of any
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;  // always and no write: no depth test
    bool depth_write = false;
    bool depth_clamp = false;  // what lies before or behind the depth range is drawn at its end, not cut off
    DepthBias depth_bias{};
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool sample_shading = false;  // a fragment for every sample, not for every pixel
    auto operator<=>(const PipelineKey&) const = default;
};

// What a key leaves to whoever knows the shaders and the vertices: the modules that serve its shaders in its
// variant, and where vertices come from.
struct PipelineParts {
    const ShaderModule* vertex = nullptr;
    const ShaderModule* fragment = nullptr;  // nullptr: no fragment shader
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;
};
using ChooseParts = std::function<PipelineParts(const PipelineKey&)>;

// The embedded modules, and no vertices.
PipelineParts plainParts(const PipelineKey& key);

// Where a pipeline is made.
struct PipelineSite {
    VkDevice device = VK_NULL_HANDLE;
    const DeviceSupport& support;
    const DeviceInfo& info;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipelineCache cache = VK_NULL_HANDLE;
    VkPipelineCreateFlags flags = 0;
    bool flattens_branches = false;  // DeviceProfile
};
PipelineSite siteOf(Device& device, VkPipelineLayout layout);
SpecializationValue valueOf(const Variant& variant);
// Throws std::runtime_error that names what the device lacks. Triangles; viewport, scissor, cull mode and
// front face are dynamic.
OwnedPipeline makePipeline(const PipelineSite& site, const PipelineKey& key, const PipelineParts& parts);
// A compute shader whose dispatches may begin at any workgroup.
OwnedPipeline makePipeline(const PipelineSite& site, const ShaderModule& module,
                           const SpecializationValue& value);

class Pipelines {
public:
    // `layout` must outlive the pipelines. Without `choose` there are no vertices.
    Pipelines(Device& device, VkPipelineLayout layout, ChooseParts choose = plainParts)
        : device_(device), layout_(layout), choose_(std::move(choose)) {}

    VkPipeline get(const PipelineKey& key) { return get(std::span(&key, 1)).front(); }
    std::vector<VkPipeline> get(std::span<const PipelineKey> keys);  // new ones are made on all cores
    // A compute shader, with a layout of its own, whose dispatches may begin at any workgroup.
    VkPipeline compute(Shader shader, const Variant& variant, VkPipelineLayout layout) {
        return compute(shaderModule(shader), variant, layout);
    }
    // `module` must outlive the pipelines.
    VkPipeline compute(const ShaderModule& module, const Variant& variant, VkPipelineLayout layout);
    VkPipelineLayout layout() const { return layout_; }
    // Destroys those that draw with such keys, of which none may be in use: a driver may hold megabytes for
    // each.
    void erase(const std::function<bool(const PipelineKey&)>& which);
    void clear();  // destroys all, of which none may be in use
    std::size_t count() const { return pipelines_.size() + compute_.size(); }

private:
    Device& device_;
    VkPipelineLayout layout_;
    ChooseParts choose_;
    std::map<PipelineKey, OwnedPipeline> pipelines_;
    std::map<std::pair<const ShaderModule*, Variant>, OwnedPipeline> compute_;
};

}  // namespace diptych
