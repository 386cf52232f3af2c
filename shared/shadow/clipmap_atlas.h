// SPDX-License-Identifier: MIT
// Clipmap pages on the GPU: one image of equal slots, and the passes that draw them.
#pragma once

#include "shared/draw/frame_inputs.h"
#include "shared/scene/motion/pose.h"
#include "shared/shadow/clipmap_cache.h"
#include "shared/vulkan/device/resources.h"

#include <glm/vec2.hpp>

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace diptych {

struct AtlasShape {
    std::uint32_t pages = 0;  // largest number of slots
    std::uint32_t slot = 0;   // texels along a slot's side
    std::uint32_t perRow() const;
    glm::uvec2 size() const;                      // texels
    glm::uvec2 cornerOf(std::uint32_t at) const;  // of a slot, texels
    auto operator<=>(const AtlasShape&) const = default;
};

// Depth as in shared/contract/shadow.h, always in the layout for shader reads. Pages are drawn at one
// position of a separate image and copied to their slots. Devices interpolate depth from the framebuffer's
// origin, so this makes a page's bits independent of its slot.
class ClipmapAtlas {
public:
    // Throws std::runtime_error naming --clipmap-pages if the device does not support an image of this
    // size.
    ClipmapAtlas(Device& device, const AtlasShape& shape);

    const AtlasShape& shape() const { return shape_; }
    ClipmapCache& cache() { return cache_; }
    VkImageView view() const { return image_.view(); }
    std::uint64_t bytes() const;

    // Invalidates cached pages that show geometry that has moved since the last call.
    void follow(const Pose& pose, const Geometry& geometry, const LightSpace& space);
    // Draws stale pages and waits. `all`: every caster in each. Returns the number of drawn pages.
    std::size_t draw(const FrameInputs& inputs, Uploader& uploader, const Pose& pose, const PageGrid& grid,
                     std::span<const PageDraw> pages, bool all);
    // Fills all texels without invalidating the cache.
    void fill(float value);
    // Texels of a slot, row by row.
    std::vector<float> read(std::uint32_t at) const;

private:
    // Everything that a caster's shadow depends on.
    struct Caster {
        int mesh = 0, primitive = 0;
        glm::dmat4 world_from_object{1};
        glm::dvec3 bounds_min{0}, bounds_max{0};  // object space
        std::vector<glm::dmat4> world_from_mesh;  // by joint
        std::vector<double> weights;              // of morph targets
        bool blends = false;                      // blended geometry casts no shadow
        AlphaMode alpha_mode = AlphaMode::opaque;
        float alpha = 1, alpha_cutoff = 0;  // of a mask, like base_color
        TextureSlot base_color{};
        bool operator==(const Caster&) const = default;
    };
    Device& device_;
    AtlasShape shape_;
    GpuImage image_;
    ClipmapCache cache_;
    std::vector<Caster> casters_;  // as drawn in the pages
};

// Atlases of one scene. A view keeps its atlas while it lives, because the pages it samples must not be
// replaced. The next view reuses the atlas with its pages.
class ClipmapAtlases {
public:
    // `frame`: layout of SET_FRAME.
    ClipmapAtlases(Device& device, VkDescriptorSetLayout frame);

    // An atlas that no view uses. Releases unused atlases of other shapes.
    std::shared_ptr<ClipmapAtlas> lend(const AtlasShape& shape);

    // For the compute shader that marks pages.
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
