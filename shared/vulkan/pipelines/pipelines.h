// SPDX-License-Identifier: MIT
// Pipelines by key; each is compiled once.
#pragma once

#include "shared/vulkan/device/device.h"
#include "shared/vulkan/spirv/specialize.h"
#include "shared/vulkan/spirv/spirv.h"
#include "shared/vulkan/spirv/variant.h"

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace diptych {

// How a colour s with coverage or opacity s.a combines with the attachment's value d; alpha follows the
// same rule.
enum class Blend : std::uint8_t {
    none,      // s
    add,       // s + d
    over,      // s + (1 - s.a) d: s is premultiplied
    multiply,  // s d
    through,   // s + s.a d: s.a is the transmittance of s; alpha stays d.a
};

// Added to the depth of every fragment: `constant` times the smallest step of the depth format at that
// depth, and `slope` times the largest change of depth per pixel. Depth is reversed: negative values move
// away.
struct DepthBias {
    float constant = 0, slope = 0;
    auto operator<=>(const DepthBias&) const = default;
};

struct PipelineKey {
    Shader vertex = Shader::none, fragment = Shader::none;  // no fragment shader: none
    Variant variant{};
    std::uint32_t input = 0;  // a vertex format, defined by the ChooseParts function; 0: none
    std::vector<VkFormat> colors{};
    std::vector<Blend> blends{};  // per colour; empty: none for all
    VkFormat depth = VK_FORMAT_UNDEFINED;
    VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;  // always without writes: no depth test
    bool depth_write = false;
    DepthBias depth_bias{};
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool sample_shading = false;  // a fragment for every sample
    auto operator<=>(const PipelineKey&) const = default;
};

// Parts that do not follow from the key alone: modules of its shaders for its variant, and the vertex
// input.
struct PipelineParts {
    const ShaderModule* vertex = nullptr;
    const ShaderModule* fragment = nullptr;  // nullptr: no fragment shader
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;
};
using ChooseParts = std::function<PipelineParts(const PipelineKey&)>;

// The embedded modules, without vertex input.
PipelineParts plainParts(const PipelineKey& key);

// Context of pipeline creation.
struct CreationContext {
    VkDevice device = VK_NULL_HANDLE;
    const DeviceSupport& support;
    const DeviceInfo& info;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipelineCache cache = VK_NULL_HANDLE;
    VkPipelineCreateFlags flags = 0;
    bool flattens_branches = false;  // DeviceProfile
};
CreationContext contextOf(Device& device, VkPipelineLayout layout);
SpecializationValue valueOf(const Variant& variant);
// Throws std::runtime_error naming what the device does not support. Topology is triangles; viewport,
// scissor, cull mode and front face are dynamic.
OwnedPipeline makePipeline(const CreationContext& context, const PipelineKey& key,
                           const PipelineParts& parts);
// A compute shader whose dispatches may begin at any workgroup.
OwnedPipeline makePipeline(const CreationContext& context, const ShaderModule& module,
                           const SpecializationValue& value);

// A pipeline of Pipelines, shared by its copies. It is created at its first use at the latest.
class Pipeline {
public:
    operator VkPipeline() const&;
    operator VkPipeline() const&& = delete;  // nothing would keep it
    bool operator==(const Pipeline&) const = default;

private:
    friend class Pipelines;
    struct State;
    std::shared_ptr<State> state_;
};

// planned: pipelines are checked and counted, and created only if they are used.
enum class Creation : std::uint8_t { at_once, planned };

// Keeps pipelines that nothing uses any more, the latest up to `maxUnused` bytes of host memory.
class Pipelines {
public:
    static constexpr std::uint64_t maxUnused = std::uint64_t{128} << 20;

    // `layout` must outlive the pipelines. Without `choose` there is no vertex input.
    Pipelines(Device& device, VkPipelineLayout layout, ChooseParts choose = plainParts,
              Creation creation = Creation::at_once)
        : device_(device), layout_(layout), choose_(std::move(choose)), creation_(creation) {}

    Pipeline get(const PipelineKey& key) { return get(std::span(&key, 1)).front(); }
    std::vector<Pipeline> get(std::span<const PipelineKey> keys);  // compiles new ones on all cores
    // A compute shader with its own layout, whose dispatches may begin at any workgroup.
    Pipeline compute(Shader shader, const Variant& variant, VkPipelineLayout layout) {
        return compute(shaderModule(shader), variant, layout);
    }
    // `module` must outlive the pipelines.
    Pipeline compute(const ShaderModule& module, const Variant& variant, VkPipelineLayout layout);
    VkPipelineLayout layout() const { return layout_; }
    // Forgets graphics pipelines with such keys, or all: drivers may need megabytes for each.
    void erase(const std::function<bool(const PipelineKey&)>& which);
    void clear() { pipelines_.clear(); }
    std::size_t made() const { return made_; }  // so far, released ones included
    // Host memory, about: of pipelines that are in use, or of the others.
    std::uint64_t bytes(bool inUse) const;

private:
    using Key = std::variant<PipelineKey, std::pair<const ShaderModule*, Variant>>;
    std::pair<Pipeline, bool> find(const Key& key);  // and whether it is new
    void create(std::span<const Pipeline> added);
    static bool isUsed(const Pipeline& pipeline) { return pipeline.state_.use_count() > 1; }
    std::uint64_t bytesOf(const Pipeline& pipeline) const;
    void releaseUnused();

    Device& device_;
    VkPipelineLayout layout_;
    ChooseParts choose_;
    Creation creation_;
    std::map<Key, Pipeline> pipelines_;
    std::uint64_t asked_ = 0;
    std::size_t made_ = 0;
};

}  // namespace diptych
