// SPDX-License-Identifier: MIT
// The shadows of points and spots on the device: their atlas, what is drawn into it, and what shading reads.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/draw/frame_inputs.h"
#include "shared/frame/settings.h"
#include "shared/shadow/local_atlas.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/pass_list.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Everything that one view of a scene needs for the shadows of the points and spots that cast. Where none
// does, or nothing is there to be seen or to cast, it has no pass.
class LocalShadows {
public:
    // Writes its bindings to `frame`, the sets of SET_FRAME. `seen`: what the picture draws. `sources`: what
    // `lights` was made of, in world space.
    LocalShadows(Device& device, Uploader& uploader, const Pose& pose, const Geometry& geometry,
                 const Materials& materials, const View& view, const DrawList& seen, const GpuLights& lights,
                 std::span<const Light> sources, DescriptorSets& frame, const Settings& settings);
    LocalShadows(const LocalShadows&) = delete;
    LocalShadows& operator=(const LocalShadows&) = delete;

    bool any() const { return !atlas_.lights.empty(); }
    bool draws() const { return !atlas_.tiles.empty(); }
    void specialise(Variant& variant) const;  // local_shadows, shadow_kernel

    // A pass named "local shadow maps", before the first that reads them. Binds the atlas, which is the
    // list's.
    void addPasses(PassList& passes, const FrameInputs& inputs);
    // Declares that the pass's fragment shaders read the atlas.
    void read(Pass& pass, VkPipelineStageFlags2 stages = inFragment) const;

    std::uint64_t bytes() const;  // of buffers; the atlas is the pass list's
    // How far across a light's rays something is read for a surface, a share of the distance from the light:
    // at most, of all tiles; 0 where there is none.
    double reach() const;
    const LocalAtlas& atlas() const { return atlas_; }
    ImageRef image() const { return image_; }  // of the pass list that passes were added to last
    // In words, for people: how many lights cast and how many do not, the atlas, what is not drawn.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    struct Map {
        DrawList casters;
        GpuBuffer draws;
    };
    DescriptorSets& frame_;
    AtlasRequest request_;
    LocalAtlas atlas_;
    gpu::uint kinds_ = 0;    // LOCAL_SHADOWS_*
    std::vector<Map> maps_;  // one a tile
    std::vector<std::string> notes_;
    GpuBuffer texels_;
    OwnedBufferView texels_view_;
    OwnedSampler nearest_;
    ImageRef image_;
};

}  // namespace diptych
