// SPDX-License-Identifier: MIT
// Descriptor set layouts and the pipeline layout that all draws share.
#pragma once

#include "shared/light/light_lists.h"
#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <span>

namespace diptych {

// Pipeline layout of every draw: SET_FRAME, SET_MATERIAL, SET_GBUFFER, SET_PARTIAL_SUMS, and DrawConstants
// as push constants. Created once per device and shared by all views.
struct Layouts {
    // `material`: the layout of SET_MATERIAL.
    Layouts(Device& device, VkDescriptorSetLayout material);
    OwnedDescriptorSetLayout frame, gbuffer, partial_sums;
    OwnedPipelineLayout pipeline;
    OwnedPipelineLayout culling;  // of the compute shader that culls triangles: struct CullingConstants
    OwnedSampler nearest;
    ListLayouts lists;
};

// Shader stages that read the push constants of a draw, or of a dispatch that replaces it.
constexpr VkShaderStageFlags drawStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

// Descriptor types of a set's bindings, indexed by binding.
std::span<const VkDescriptorType> frameBindings();
std::span<const VkDescriptorType> gbufferBindings();
std::span<const VkDescriptorType> partialSumBindings();

// Dummy descriptors of black texels for bindings that shaders declare and do not read. lavapipe and the
// validation layers access every descriptor.
class Placeholders {
public:
    Placeholders(Device& device, Uploader& uploader, const Layouts& layouts);
    VkDescriptorSet partialSums() const { return partial_sums_[0]; }  // for draws without earlier sums
    VkDescriptorSet gbuffer() const { return gbuffer_[0]; }           // for draws without stored depth
    VkImageView texel() const { return image_.view(); }
    // Writes the bindings of SET_FRAME that only some scenes and settings use: shadows, environment, haze.
    void bindFrame(DescriptorSets& frame) const;
    // Writes all image and storage buffer bindings of a SET_GBUFFER.
    void bindGBuffer(DescriptorSets& gbuffer, const Layouts& layouts) const;

private:
    GpuImage image_, array_;
    GpuBuffer texels_, storage_;
    OwnedBufferView texels_view_;
    OwnedSampler nearest_;
    DescriptorSets partial_sums_, gbuffer_;
};

}  // namespace diptych
