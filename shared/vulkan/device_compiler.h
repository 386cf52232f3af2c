// SPDX-License-Identifier: MIT
// Compiles the pipelines that another device makes, by a GPU's own compiler. That needs instance, device,
// layouts and modules alone: RADV without hardware has those, but no memory, image, fence or command buffer.
#pragma once

#include "shared/vulkan/compiled_shader.h"
#include "shared/vulkan/pipeline_compiler.h"
#include "shared/vulkan/pipelines.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// A pipeline as a pass has asked for it.
struct PipelineRequest {
    std::string pass{};                        // declared last when it was asked for
    VkPipelineLayout layout = VK_NULL_HANDLE;  // of the device that draws
    PipelineKey key{};                         // of a draw
    ChooseParts choose{};
    const ShaderModule* kernel = nullptr;  // of a dispatch; nullptr: it is a draw
    Variant kernel_variant{};

    const Variant& variant() const { return kernel != nullptr ? kernel_variant : key.variant; }
    Variant& variant() { return kernel != nullptr ? kernel_variant : key.variant; }
    // The file of the shader that it is called by: the kernel, the fragment shader, or of depth alone the
    // vertex shader.
    std::string name() const;
    bool operator==(const PipelineRequest& other) const {
        return pass == other.pass && layout == other.layout && key == other.key && kernel == other.kernel &&
               kernel_variant == other.kernel_variant;
    }
};

struct CompiledPipeline {
    std::vector<CompiledShader> shaders;  // none: it did not compile
    std::string error;                    // why not, or what it asks for that the device does not have
};

// `Device` with DeviceOptions::compiler makes the choices of this compiler's device and tells it of layouts,
// passes and pipelines.
class DeviceCompiler final : public PipelineCompiler {
public:
    // An index of listDevices(), part of a device's name, or a family of AMD GPUs as RADV calls it
    // ("navi31"), which RADV of Mesa compiles for without one. Throws std::runtime_error naming --compile-on
    // and what lacks.
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

    // Those asked for since the last call, each once, in order.
    std::vector<PipelineRequest> takeRequests();
    // On all cores.
    std::vector<CompiledPipeline> compile(std::span<const PipelineRequest> requests) const;

private:
    struct State;
    void add(PipelineRequest request);

    std::unique_ptr<State> state_;
};

}  // namespace diptych
