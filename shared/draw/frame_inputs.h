// SPDX-License-Identifier: MIT
// What a path is given, and what it gives.
#pragma once

#include "shared/draw/draw_list.h"
#include "shared/draw/object_lights.h"
#include "shared/light/light_lists.h"
#include "shared/light/ltc_image.h"
#include "shared/material/gbuffer_layout.h"
#include "shared/vulkan/pass_list.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// The pipeline layout of every pass: SET_FRAME, SET_MATERIAL, SET_GBUFFER, SET_CARRIED.
struct Layouts {
    Layouts(Device& device, VkDescriptorSetLayout material);
    OwnedDescriptorSetLayout frame, gbuffer, carried;
    OwnedPipelineLayout pipeline;
    OwnedSampler nearest;
    ListLayouts lists;
};

// Kinds of the bindings of SET_FRAME, in order.
std::span<const VkDescriptorType> frameBindings();

// SET_CARRIED of draws that carry nothing on, and a black texel for whatever else a shader names and does not
// read: lavapipe and validation follow every descriptor.
class NothingCarried {
public:
    NothingCarried(Device& device, Uploader& uploader, const Layouts& layouts);
    VkDescriptorSet set() const { return sets_[0]; }
    VkImageView texel() const { return image_.view(); }

private:
    GpuImage image_;
    DescriptorSets sets_;
};

// The buffers of one view: camera, draws, lights and their lists; bound as SET_FRAME. `objectPixelLights`:
// --pixel-lights of --assign per_object.
class FrameBuffers {
public:
    FrameBuffers(Device& device, Uploader& uploader, const Layouts& layouts, const View& view,
                 const DrawList& draws, const GpuLights& lights, const LightLists::Choice& choice,
                 std::optional<std::uint32_t> objectPixelLights = {});
    VkDescriptorSet set() const { return sets_[0]; }
    VkBuffer draws() const { return draws_.handle(); }
    VkDescriptorSet carriedNothing() const { return carried_nothing_.set(); }
    LightLists& lists() { return lists_; }
    const ObjectLightBuffers& objects() const { return objects_; }
    std::uint64_t bytes() const {
        return view_.size() + packed_view_.size() + draws_.size() + lights_.size() + spot_cones_.size() +
               area_lights_.size() + ltc_.bytes() + albedo_.size() + lists_.bytes() + objects_.bytes();
    }

private:
    GpuBuffer view_, packed_view_, draws_, lights_, spot_cones_, area_lights_, albedo_;
    OwnedBufferView packed_view_texels_, lights_view_, spot_cones_view_, area_lights_view_;
    LtcImage ltc_;
    LightLists lists_;
    ObjectLightBuffers objects_;
    NothingCarried carried_nothing_;
    DescriptorSets sets_;
};

struct FrameInputs {
    Device& device;
    const Layouts& layouts;
    Pipelines& pipelines;
    const Geometry& geometry;
    const Materials& materials;
    const DrawList& draws;
    VkBuffer draw_buffer;  // Draw[draws.draws]
    VkDescriptorSet frame_set;
    VkDescriptorSet
        carried_nothing;  // SET_CARRIED of draws that carry nothing on: shaders name it all the same
    LightLists& lists;
    Variant variant;  // of the scene and the view: lights there, emission, projection, G-buffer encoding
    GBufferLayout gbuffer;
    bool prepass = true;         // forward+
    gpu::uint light_groups = 0;  // of the longest list that there may be
};

struct FrameImages {
    ImageRef lit;                                              // RGBA32F, linear scene-referred radiance
    ImageRef depth;                                            // D32F, reversed
    std::array<ImageRef, gpu::GBUFFER_ATTACHMENTS> gbuffer{};  // deferred; invalid where there is none
};

constexpr VkFormat litFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;

// The features of the scene that a pass's shaders can see; the rest would only make more pipelines.
Variant sceneVariant(const Requirements& needs, const GpuLights& lights, const View& view,
                     const GBufferLayout& gbuffer, AreaLights area_lights);

// The groups of each light list that one draw walks, and the sums that it goes on from.
struct LightChunk {
    gpu::uint kind = gpu::CHUNK_WHOLE;
    gpu::uint first = 0, end = 0;         // groups from a list's begin
    std::array<ImageRef, 2> images = {};  // the sums, which the pass must declare that it samples
    std::shared_ptr<const DescriptorSets> carried = {};

    void read(Pass& pass) const;  // declares the images, where there are some
};

// Draws every item in order with the pipeline of its key; pipelines that are not there yet are made on all
// cores.
using KeyOf = std::function<PipelineKey(const DrawItem&)>;
std::function<void(VkCommandBuffer)> recordDraws(const FrameInputs& inputs, const KeyOf& keyOf,
                                                 const LightChunk& chunk = {});

// One triangle over the screen, with what is bound.
void recordTriangle(VkCommandBuffer commands, VkPipeline pipeline);
// The same, reading the G-buffer.
void recordFullScreen(VkCommandBuffer commands, const FrameInputs& inputs, VkPipeline pipeline,
                      VkDescriptorSet gbuffer, const LightChunk& chunk);

// Adds a draw for each chunk of the lights but the last, which is returned for the pass that ends the sum:
// with up to MAX_LIGHTS_PER_DRAW groups there is one chunk, CHUNK_WHOLE, and no draw. `add` declares depth
// and what is read besides, and records the drawing of one chunk into attachments 0 (diffuse) and 1
// (specular).
using AddChunk = std::function<void(Pass&, const LightChunk&)>;
LightChunk addEarlierLights(PassList& passes, const FrameInputs& inputs, const AddChunk& add);

// The depth pipeline's key: only what can cut a hole matters to it.
PipelineKey depthKey(const DrawItem& item);

// A capture pass: up to CAPTURE_ATTACHMENTS channels. Channels that need no light come first, so that as
// few passes as the attachments allow hold them all and only the last ones shade.
struct CaptureGroup {
    std::vector<int> modes;         // debug modes, one an attachment
    std::vector<VkFormat> formats;  // float32, as wide as the channel
    void specialise(Variant& variant) const;
};
std::vector<CaptureGroup> captureGroups(std::span<const int> modes);

struct CapturedImage {
    int mode = 0;
    ImageRef image;
    bool through_gbuffer = false;  // forward+: of a surface that was encoded and decoded
};

// What a capture is asked for: channels as they are, and channels of surfaces that went through the
// G-buffer's encoding (forward+ only; what the deferred path has to show).
struct CaptureRequest {
    std::vector<int> modes, through_gbuffer;
};

// Adds the group's attachments to a pass, cleared to what the background holds (0; material_id -1).
std::vector<CapturedImage> addCaptureImages(PassList& passes, Pass& pass, const CaptureGroup& group);

}  // namespace diptych
