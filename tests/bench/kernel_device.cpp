// SPDX-License-Identifier: MIT
#include "tests/bench/kernels.h"

#include "shared/contract/bindings.h"
#include "shared/contract/geometry.h"
#include "shared/contract/light_list.h"
#include "shared/draw/frame_inputs.h"
#include "shared/draw/layouts.h"
#include "shared/vulkan/instance/check.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace diptych::kernels {

std::span<const ShaderModule> shaderModules();  // tests/bench/shaders, written by embed_spirv

namespace {

constexpr VkBufferUsageFlags anyBuffer = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                         VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
// Other light buffers of the kernels: SET_MATERIAL, bindings 0 and 1.
constexpr std::array lightTypes{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

template <class T>
GpuBuffer filled(Device& device, const std::string& name, const std::vector<T>& data) {
    GpuBuffer buffer(device, name, data.size() * sizeof(T), anyBuffer, MemoryUse::upload);
    std::memcpy(buffer.mapped(), data.data(), data.size() * sizeof(T));
    return buffer;
}

const ShaderModule& moduleOf(const DeviceKernel& kernel) {
    for (const ShaderModule& module : kernels::shaderModules())
        if (module.name == kernel.shader) return module;
    throw std::logic_error(fmt::format("no shader of bench_kernels is called {}", kernel.shader));
}

class Drawn final : public DrawnKernel {
public:
    Drawn(Device& device, const KernelWorkload& workload, const DeviceKernel& kernel)
        : workload_(workload),
          lightsLayout_(makeSetLayout(device, lightTypes)),
          layouts_(device, lightsLayout_),
          pipelines_(device, layouts_.pipeline,
                     [module = &moduleOf(kernel)](const PipelineKey& key) {
                         return PipelineParts{&shaderModule(key.vertex), module, {}, {}};
                     }),
          lights_(filled(device, "lights", workload.lights)),
          indices_(filled(device, "lists", workload.indices)),
          uploader_(device),
          nothing_(device, uploader_, layouts_),
          unread_(device, "unread", 4096, anyBuffer),
          lightsView_(makeTexelView(device, "lights", lights_, VK_FORMAT_R32G32B32A32_SFLOAT)),
          indicesView_(makeTexelView(device, "lists", indices_, VK_FORMAT_R32G32B32A32_UINT)),
          frameSets_(device, layouts_.frame, frameBindings(), 1),
          lightSets_(device, lightsLayout_, lightTypes, 1),
          passes_(device, static_cast<std::uint32_t>(workload.size.width),
                  static_cast<std::uint32_t>(workload.size.height)) {
        bind();
        Variant variant;
        variant.set(gpu::FEATURE_point_lights)
            .set(gpu::FEATURE_light_lists, gpu::LISTS_CLUSTERED)
            .set(gpu::FEATURE_list_width, 4);
        target_ = passes_.image("lit", litFormat);
        const Pipeline pipeline =
            pipelines_.get({.vertex = Shader::full_screen_vert, .variant = variant, .colors = {litFormat}});
        passes_.draw(kernel.name)
            .color(target_, Load::clear)
            .record([this, pipeline](VkCommandBuffer commands) { record(commands, pipeline); });
    }

    double draw(int listLength) override {
        length_ = listLength;
        return passes_.run();
    }

    Image image() override {
        Image image(workload_.size.width, workload_.size.height, 3);
        passes_.readBack(std::array{PassList::ReadBack{target_, 3}}, std::array{std::span(image.data)});
        return image;
    }

private:
    // Binds every declared binding; shaders read only lights and lists.
    void bind() {
        const std::span<const VkDescriptorType> types = frameBindings();
        for (std::uint32_t i = 0; i < types.size(); ++i) {
            // Light buffers hold floats; lists and the packed view hold integers.
            const bool floats = i == gpu::BINDING_LIGHTS || i == gpu::BINDING_SPOT_CONES ||
                                i == gpu::BINDING_AREA_LIGHTS || i == gpu::BINDING_ALBEDO;
            if (types[i] == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER)
                frameSets_.texels(0, i, floats ? lightsView_ : indicesView_);
            else if (types[i] == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
                     types[i] == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)
                frameSets_.buffer(0, i, unread_.handle());
            else
                frameSets_.image(0, i, nothing_.texel(), layouts_.nearest,
                                 VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
        nothing_.bindFrame(frameSets_);
        for (std::uint32_t i = 0; i < lightTypes.size(); ++i) lightSets_.buffer(0, i, lights_.handle());
    }

    void record(VkCommandBuffer commands, const Pipeline& pipeline) const {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        const std::array<VkDescriptorSet, 2> sets{frameSets_[0], lightSets_[0]};
        static_assert(gpu::SET_FRAME == 0 && gpu::SET_MATERIAL == 1);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts_.pipeline, 0, sets.size(),
                                sets.data(), 0, nullptr);
        const VkDescriptorSet sums = nothing_.partialSums();
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts_.pipeline,
                                gpu::SET_PARTIAL_SUMS, 1, &sums, 0, nullptr);
        vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
        vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
        gpu::DrawConstants constants{};
        constants.draw = static_cast<gpu::uint>(workload_.tilesAcross());
        constants.material = static_cast<gpu::uint>(workload_.list_capacity / 4);
        constants.light_end = static_cast<gpu::uint>(length_ / 4);
        vkCmdPushConstants(commands, layouts_.pipeline, drawStages, 0, sizeof constants, &constants);
        vkCmdDraw(commands, 3, 1, 0, 0);
    }

    const KernelWorkload& workload_;
    OwnedDescriptorSetLayout lightsLayout_;
    Layouts layouts_;
    Pipelines pipelines_;
    GpuBuffer lights_, indices_;
    Uploader uploader_;
    Placeholders nothing_;
    GpuBuffer unread_;
    OwnedBufferView lightsView_, indicesView_;
    DescriptorSets frameSets_, lightSets_;
    PassList passes_;
    ImageRef target_;
    int length_ = 0;
};

}  // namespace

const std::vector<DeviceKernel>& deviceKernels() {
    static const std::vector<DeviceKernel> kernels{
        {"texel buffer, as the paths read it", "lights_texels.frag", false, {}},
        {"uniform buffer, uniform base", "lights_uniform_base.frag", true, 2.4},
        {"uniform buffer, divergent base", "lights_uniform.frag", false, 2.8},
        {"storage buffer, divergent base", "lights_storage.frag", false, 3.3}};
    return kernels;
}

std::string whyNotDrawn(const Device& device, const DeviceKernel& kernel) {
    const bool ballots =
        device.support().hasSubgroups(VK_SHADER_STAGE_FRAGMENT_BIT, VK_SUBGROUP_FEATURE_BALLOT_BIT);
    return kernel.subgroups && !ballots ? device.info().name + " has no subgroup ballots in fragment shaders"
                                        : "";
}

std::unique_ptr<DrawnKernel> makeDrawnKernel(Device& device, const KernelWorkload& workload,
                                             const DeviceKernel& kernel) {
    return std::make_unique<Drawn>(device, workload, kernel);
}

}  // namespace diptych::kernels
