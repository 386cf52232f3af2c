// SPDX-License-Identifier: MIT
// The pages of clipmaps on the device: one image of equal slots, and what is drawn into them.
#pragma once

#include "shared/draw/frame_inputs.h"
#include "shared/scene/motion/pose.h"
#include "shared/shadow/clipmap_cache.h"
#include "shared/vulkan/resources.h"

#include <glm/vec2.hpp>

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace diptych {

struct AtlasShape {
    std::uint32_t pages = 0;  // slots, at most
    std::uint32_t slot = 0;   // texels of a slot's side
    std::uint32_t perRow() const;
    glm::uvec2 size() const;                      // texels
    glm::uvec2 cornerOf(std::uint32_t at) const;  // of a slot, texels
    auto operator<=>(const AtlasShape&) const = default;
};

// Depth as in shared/contract/shadow.h, always in the layout in which shaders read it. Every page is drawn
// to the same place of one image and copied to its slot: devices interpolate depth from the framebuffer's
// origin, and so a page has the same bits wherever its slot is.
class ClipmapAtlas {
public:
    // Throws std::runtime_error naming --clipmap-pages where the device has no image so large.
    ClipmapAtlas(Device& device, const AtlasShape& shape);

    const AtlasShape& shape() const { return shape_; }
    ClipmapCache& cache() { return cache_; }
    VkImageView view() const { return image_.view(); }
    std::uint64_t bytes() const;

    // Has the cache forget what shows something that has moved since the last call.
    void follow(const Pose& pose, const Geometry& geometry, const LightSpace& space);
    // Draws those pages that are not drawn yet, and waits. `all`: every caster into each. Returns how many
    // they were.
    std::size_t draw(const FrameInputs& inputs, Uploader& uploader, const Pose& pose, const PageGrid& grid,
                     std::span<const PageDraw> pages, bool all);
    // All texels, whatever they belong to; the cache does not hear of it.
    void fill(float value);
    // A slot's texels, row by row.
    std::vector<float> read(std::uint32_t at) const;

private:
    // What a caster's shadow follows from.
    struct Caster {
        int mesh = 0, primitive = 0;
        glm::dmat4 world_from_object{1};
        glm::dvec3 bounds_min{0}, bounds_max{0};  // object
        std::vector<glm::dmat4> world_from_mesh;  // by joint
        std::vector<double> weights;              // of morph targets
        bool blends = false;                      // casts nothing then
        AlphaMode alpha_mode = AlphaMode::opaque;
        float alpha = 1, alpha_cutoff = 0;  // of a mask, like the next
        TextureSlot base_color{};
        bool operator==(const Caster&) const = default;
    };
    Device& device_;
    AtlasShape shape_;
    GpuImage image_;
    ClipmapCache cache_;
    std::vector<Caster> casters_;  // that the pages show
};

// The atlases of one scene. A view keeps its own for as long as it lives, as what it reads must not be
// replaced; the next view goes on with the pages that the last has left.
class ClipmapAtlases {
public:
    // `frame`: the layout of SET_FRAME.
    ClipmapAtlases(Device& device, VkDescriptorSetLayout frame);

    // One that no view has. Those of another shape that no view has are given up.
    std::shared_ptr<ClipmapAtlas> lend(const AtlasShape& shape);

    // Of the kernel that marks pages.
    VkDescriptorSetLayout marks() const { return marks_; }
    VkPipelineLayout pipeline() const { return pipeline_; }

private:
    Device& device_;
    OwnedDescriptorSetLayout marks_;
    OwnedPipelineLayout pipeline_;
    std::vector<std::shared_ptr<ClipmapAtlas>> atlases_;
};

// Descriptor types of SET_CLIPMAP, indexed by binding.
std::span<const VkDescriptorType> clipmapBindings();

}  // namespace diptych
