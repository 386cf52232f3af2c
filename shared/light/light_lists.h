// SPDX-License-Identifier: MIT
// Light lists on the device: the buffers of one view and the passes that fill them.
#pragma once

#include "shared/light/light_grid.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/pass_list.h"
#include "shared/vulkan/pipelines.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// What fills the masks: threads of each light that walk the cells it may reach, or threads of each tile that
// test the lights which may reach both the tile and a slice. Both apply the same test, so the lists are the
// same.
enum class ListKernel { scatter, gather };

// Descriptor types of SET_LISTS, indexed by binding.
std::span<const VkDescriptorType> listBindings();

// The layout of the kernels, one for all views.
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

// For a buffer that shaders read as texels or, where `addressed`, by its address.
constexpr VkBufferUsageFlags texelsOrAddress =
    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
OwnedBufferView texelsUnless(bool addressed, Device& device, const std::string& name, const GpuBuffer& buffer,
                             VkFormat format);

// The light lists of one view. Kernels first make bit masks, one bit for each list and light, whose order
// needs no sorting; then count the bits, place the lists by a prefix sum, and write them as indices. No light
// is ever dropped: a list that does not fit into the buffer is replaced by the list of all lights, and such
// lists are counted.
class LightLists {
public:
    struct Choice {
        gpu::uint lists = gpu::LISTS_NONE;  // LISTS_*; none: buffers to bind and no pass
        ListKernel kernel = ListKernel::scatter;
        bool in_front = false;  // tiled, and something is blended: FEATURE_lights_in_front
    };

    // `frame_set` of addPasses() must hold View and what this binds. Throws std::runtime_error where memory
    // ends.
    LightLists(Device& device, Uploader& uploader, const ListLayouts& layouts, const Choice& choice,
               const View& view, const GpuLights& lights);

    const gpu::LightGrid& grid() const { return grid_; }
    bool any() const { return choice_.lists != gpu::LISTS_NONE; }
    // Whether shaders read lights and lists by their addresses, as one of these has more texels than a texel
    // buffer of the device.
    bool addressed() const { return addressed_; }
    void specialise(Variant& variant) const;  // light_lists, list_width, addressed_lights, lights_in_front

    // Writes the bindings LIGHT_GRID, LIST_HEADS, LIST_INDICES and LIST_COUNTS of a frame's set.
    void bind(DescriptorSets& frame) const;

    // Passes named "assign ..."; tiled lists read `depth`, which earlier passes have drawn. `variant`: the
    // scene's.
    void addPasses(PassList& passes, Pipelines& pipelines, const Variant& variant, VkDescriptorSet frame_set,
                   ImageRef depth);

    // Declares that the pass's fragment shaders walk the lists.
    void read(PassList& passes, Pass& pass, VkPipelineStageFlags2 stages = inFragment) const;

    std::uint64_t overflowed() const;  // lists of the last frame that found no room; reads back
    std::uint64_t bytes() const;
    // The local lights that the last frame's list at a pixel holds, as their places in GpuLights::lights, in
    // ascending order; empty without lists. `depth`: what the pixel shows, view depth, m. Reads back. A
    // surface of several samples that lies behind its tile's depths has another list, that of all lights, and
    // so has a tile's blended surface.
    std::vector<gpu::uint> lightsAt(int x, int y, float depth) const;
    // What the last frame left, for tests: heads, then all numbers of the index buffer.
    const GpuBuffer& heads() const { return heads_; }
    const GpuBuffer& indices() const { return indices_; }
    const GpuBuffer& masks() const { return masks_; }
    const GpuBuffer& candidates() const { return candidates_; }  // with ListKernel::gather

private:
    Device& device_;
    const ListLayouts& layouts_;
    Choice choice_;
    gpu::LightGrid grid_{};
    bool addressed_ = false;
    GpuBuffer grid_buffer_, bounds_, candidates_, masks_, used_words_, four_begins_, counts_, tile_depths_,
        overflow_, overflow_seen_, heads_, indices_, listed_;
    OwnedBufferView bounds_view_, masks_view_, heads_view_, indices_view_;
    OwnedSampler sampler_;
    DescriptorSets sets_;
};

}  // namespace diptych
