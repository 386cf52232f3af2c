// SPDX-License-Identifier: MIT
// Compiles another device's pipelines with a GPU's own compiler. It needs only instance, device, layouts
// and modules. RADV without hardware supports those, but no memory, images, fences or command buffers.
#pragma once

#include "shared/vulkan/device/pipeline_compiler.h"
#include "shared/vulkan/pipelines/compiled_shader.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// A pipeline requested by a pass.
struct PipelineRequest {
    std::string pass{};                        // the last declared pass
    VkPipelineLayout layout = VK_NULL_HANDLE;  // of the drawing device
    PipelineKey key{};                         // of a draw
    ChooseParts choose{};
    const ShaderModule* kernel = nullptr;  // of a dispatch; nullptr for a draw
    Variant kernel_variant{};

    const Variant& variant() const { return kernel != nullptr ? kernel_variant : key.variant; }
    Variant& variant() { return kernel != nullptr ? kernel_variant : key.variant; }
    // File name of its main shader: the compute shader, the fragment shader, or for depth passes the
    // vertex shader.
    std::string name() const;
    bool operator==(const PipelineRequest& other) const {
        return pass == other.pass && layout == other.layout && key == other.key && kernel == other.kernel &&
               kernel_variant == other.kernel_variant;
    }
};

struct CompiledPipeline {
    std::vector<CompiledShader> shaders;  // empty if compilation failed
    std::string error;                    // reason of the failure, or what the device does not support
};

// A `Device` with DeviceOptions::compiler makes choices as for this compiler's device and reports its
// layouts, passes and pipelines to it.
class DeviceCompiler final : public PipelineCompiler {
public:
    // `choice`: an index of listDevices(), part of a device's name, or RADV's name of an AMD GPU family
    // ("navi31"), which RADV can compile for without hardware. Throws std::runtime_error naming
    // --compile-on and the reason.
    explicit DeviceCompiler(const std::string& choice);
    ~DeviceCompiler() override;

    const DeviceInfo& info() const override;
    const VkPhysicalDeviceLimits& limits() const override;

    void addLayout(VkDescriptorSetLayout of, std::span<const VkDescriptorType> types) override;
    void addLayout(VkPipelineLayout of, std::span<const VkDescriptorSetLayout> sets,
                   const std::optional<VkPushConstantRange>& constants) override;
    void beginPass(const std::string& name) override;
    void ask(VkPipelineLayout layout, const PipelineKey& key, const ChooseParts& choose) override;
    void ask(VkPipelineLayout layout, const ShaderModule& kernel, const Variant& variant) override;

    // Distinct requests since the last call, in order.
    std::vector<PipelineRequest> takeRequests();
    // Uses all cores.
    std::vector<CompiledPipeline> compile(std::span<const PipelineRequest> requests) const;

private:
    struct State;
    void add(PipelineRequest request);

    std::unique_ptr<State> state_;
};

}  // namespace diptych
