// SPDX-License-Identifier: MIT
// Light lists on the GPU: the buffers of one view and the passes that fill them.
#pragma once

#include "shared/light/light_grid.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// How lights are culled, which fills masks. scatter: threads per light iterate over the cells in its range.
// gather: threads per tile test the lights that may reach both the tile and a slice. Both use the same test,
// so the lists are equal.
enum class LightCullingKernel { scatter, gather };

// Descriptor types of SET_LISTS, indexed by binding.
std::span<const VkDescriptorType> listBindings();

// Layout of the compute shaders, shared by all views.
class ListLayouts {
public:
    ListLayouts() = default;
    // `frame`: the layout of SET_FRAME.
    ListLayouts(Device& device, VkDescriptorSetLayout frame);
    VkDescriptorSetLayout lists() const { return lists_; }
    VkPipelineLayout pipeline() const { return pipeline_; }

private:
    OwnedDescriptorSetLayout lists_;
    OwnedPipelineLayout pipeline_;
};

// Usage of a buffer that shaders read as texels or, if `addressed`, by its address.
constexpr VkBufferUsageFlags texelsOrAddress =
    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
OwnedBufferView texelsUnless(bool addressed, Device& device, const std::string& name, const GpuBuffer& buffer,
                             VkFormat format);

// Light lists of one view. Compute shaders first fill bit masks, one bit per list and light, which need no
// sorting. They then count the bits, allocate the lists by a prefix sum, and write indices. No light is
// dropped: a list that does not fit the buffer becomes the list of all lights, and is counted.
class LightLists {
public:
    struct Choice {
        gpu::uint lists = gpu::LISTS_NONE;  // LISTS_*; LISTS_NONE: buffers to bind, without passes
        LightCullingKernel kernel = LightCullingKernel::scatter;
        bool in_front = false;  // tiled lists with blended surfaces: FEATURE_lights_in_front
    };

    // `frame_set` of addPasses() must contain View and the bindings of bind(). Throws std::runtime_error
    // if memory runs out.
    LightLists(Device& device, Uploader& uploader, const ListLayouts& layouts, const Choice& choice,
               const View& view, const GpuLights& lights);

    const gpu::LightGrid& grid() const { return grid_; }
    bool any() const { return choice_.lists != gpu::LISTS_NONE; }
    // Whether shaders read lights and lists by address, because one of them exceeds the device's largest
    // texel buffer.
    bool addressed() const { return addressed_; }
    void specialise(Variant& variant) const;  // light_lists, list_width, addressed_lights, lights_in_front

    // Writes the bindings LIGHT_GRID, LIST_HEADS, LIST_INDICES and LIST_COUNTS of a frame's set.
    void bind(DescriptorSets& frame) const;

    // Adds passes named "assign ...". Tiled lists read `depth`, which earlier passes have drawn.
    // `variant`: of the scene.
    void addPasses(PassList& passes, Pipelines& pipelines, const Variant& variant, VkDescriptorSet frame_set,
                   ImageRef depth);

    // Declares that shaders of the pass read the lists.
    void read(PassList& passes, Pass& pass, VkPipelineStageFlags2 stages = inFragment) const;

    std::uint64_t overflowed() const;  // lists of the last frame that overflowed; reads back
    std::uint64_t bytes() const;
    // Local lights of the last frame's list at a pixel, as indices into GpuLights::lights, ascending;
    // empty without lists. `depth`: view depth of the pixel, m. Reads back. Not for blended surfaces in
    // tiled lists, and not for multisampled surfaces behind their tile's depths: those use other lists.
    std::vector<gpu::uint> lightsAt(int x, int y, float depth) const;
    // Buffers of the last frame, for tests.
    const GpuBuffer& heads() const { return heads_; }
    const GpuBuffer& indices() const { return indices_; }
    const GpuBuffer& masks() const { return masks_; }
    const GpuBuffer& candidates() const { return candidates_; }  // with LightCullingKernel::gather

private:
    struct Step;
    void addLightCulling(const Step& step, ImageRef depth) const;
    void addListBuilding(const Step& step) const;
    void makeLists();
    // Buffers of the passes that fill the lists, and their descriptor set.
    void makePassInputs();
    // 32-bit words that the last frame's passes wrote.
    std::vector<gpu::uint> wordsOf(const GpuBuffer& from, std::uint64_t first, std::size_t count) const;

    Device& device_;
    const ListLayouts& layouts_;
    Choice choice_;
    gpu::LightGrid grid_{};
    bool addressed_ = false;
    GpuBuffer grid_buffer_, bounds_, candidates_, masks_, used_words_, four_begins_, counts_, tile_depths_,
        overflow_, heads_, indices_, listed_;
    OwnedBufferView bounds_view_, masks_view_, heads_view_, indices_view_;
    OwnedSampler sampler_;
    DescriptorSets sets_;
};

}  // namespace diptych
