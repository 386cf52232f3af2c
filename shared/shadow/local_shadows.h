// SPDX-License-Identifier: MIT
// Shadows of point and spot lights on the GPU: their atlas, its passes, and data for shading.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/draw/frame_inputs.h"
#include "shared/frame/settings.h"
#include "shared/shadow/local_atlas.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Inputs of the shadow maps of a view.
struct ShadowedView {
    const Pose& pose;
    const Geometry& geometry;
    const Materials& materials;
    const View& view;
    const DrawList& seen;            // draws of the image
    const GpuLights& lights;         // made from `sources`
    std::span<const Light> sources;  // world space
};

// Shadows of one view's casting points and spots. Adds no pass without such lights, visible geometry or
// casters.
class LocalShadows {
public:
    // Writes its bindings to `frame`, SET_FRAME.
    LocalShadows(Device& device, Uploader& uploader, const ShadowedView& scene, DescriptorSets& frame,
                 const Settings& settings);
    LocalShadows(const LocalShadows&) = delete;
    LocalShadows& operator=(const LocalShadows&) = delete;

    bool any() const { return !atlas_.lights.empty(); }
    bool draws() const { return !atlas_.tiles.empty(); }
    void specialise(Variant& variant) const;  // local_shadows, shadow_kernel

    // Adds a pass named "local shadow maps" before the first that samples them, and binds the atlas, an
    // image of the list.
    void addPasses(PassList& passes, const FrameInputs& inputs);
    // Declares that shaders of the pass sample the atlas.
    void read(Pass& pass, VkPipelineStageFlags2 stages = inFragment) const;

    std::uint64_t bytes() const;  // of buffers; the atlas belongs to the pass list
    // Largest filter radius over all tiles, relative to the distance from the light; 0 without tiles.
    double filterRadius() const;
    const LocalAtlas& atlas() const { return atlas_; }
    ImageRef image() const { return image_; }  // in the pass list of the last addPasses()
    // Text for people: number of lights with and without shadows, the atlas, missing tiles.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    struct Map {
        DrawList casters;
        GpuBuffer draws;
    };
    void layOut(const ShadowedView& scene);
    // Returns the number of draws.
    std::size_t listCasters(Device& device, Uploader& uploader, const ShadowedView& scene,
                            ShadowCasters which);

    DescriptorSets& frame_;
    AtlasRequest request_;
    LocalAtlas atlas_;
    gpu::uint kinds_ = 0;    // LOCAL_SHADOWS_*
    std::vector<Map> maps_;  // one per tile
    std::vector<std::string> notes_;
    GpuBuffer texels_;
    OwnedBufferView texels_view_;
    OwnedSampler nearest_;
    ImageRef image_;
};

}  // namespace diptych
