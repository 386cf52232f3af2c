// SPDX-License-Identifier: MIT
// Inputs and outputs of a path.
#pragma once

#include "shared/draw/depth_storage.h"
#include "shared/draw/draw_list.h"
#include "shared/draw/layouts.h"
#include "shared/draw/posing.h"
#include "shared/frame/settings.h"
#include "shared/material/gbuffer_layout.h"
#include "shared/vulkan/passes/pass_list.h"

#include <array>
#include <memory>

namespace diptych {

class Culling;
// Forward-declared from higher layers.
class ShadowMaps;
class FragmentLists;

// One view of a scene under one Settings. The referenced objects must outlive it.
struct FrameInputs {
    Device& device;
    const Layouts& layouts;
    Pipelines& pipelines;
    const Geometry& geometry;
    const Posing& posing;
    const Materials& materials;
    const DrawList& draws;
    const GpuLights& lights;
    VkBuffer draw_buffer;                      // Draw[draws.draws]
    VkBuffer sorted_indices = VK_NULL_HANDLE;  // DrawList::sorted_indices; null if empty
    const Culling* culling = nullptr;  // of draws with DrawItem::uses_visible_indices; null without them
    VkDescriptorSet frame_set;         // SET_FRAME
    const Placeholders& placeholders;
    LightLists& lists;
    Variant variant;  // features of scene and view: light types, emission, projection, G-buffer encoding
    GBufferLayout gbuffer;
    Lighting lighting = Lighting::fragment;  // deferred path
    gpu::uint layers = 0;                    // LAYER_* of opaque surfaces, wherever they are drawn
    DepthStorage depth{};
    VkFormat lit_format = VK_FORMAT_R32G32B32A32_SFLOAT;  // format of the image's radiance
    ShadowMaps& shadow;
    Transparency transparency = Transparency::sorted;
    bool blurred_backdrop = false;             // transmissive surfaces may be rough
    gpu::BlendedConstants blended{};           // of all blended passes
    const FragmentLists* fragments = nullptr;  // Transparency::list
    gpu::uint longest_list = 0;                // entries of the longest list that a pixel may evaluate
    gpu::uint entries_per_draw = 1;            // of them that one draw evaluates; see entriesPerDraw()
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  // per pixel, in images that draws write
    bool sample_shading = false;                            // a fragment per sample
    MsaaEdges edges = MsaaEdges::exact;
    bool alpha_to_coverage = false;  // alpha masks select samples
    bool prepass = true;             // forward+ draws a depth pre-pass; set by prepareForwardPlus()
};

// Culling and deformation: the first passes of a path.
void addGeometryPasses(PassList& passes, const FrameInputs& inputs);
// Declares that the pass draws the view's items; returns the pass.
Pass& readGeometry(PassList& passes, Pass& pass, const FrameInputs& inputs);

struct FrameImages {
    ImageRef lit;          // linear scene-referred radiance, of FrameInputs::lit_format
    ImageRef lit_samples;  // per-sample radiance, before the resolve
    ImageRef depth;        // stored as in FrameInputs::depth
    std::array<ImageRef, gpu::GBUFFER_ATTACHMENTS> gbuffer{};  // deferred; invalid if absent
    ImageRef groups{};                         // deferred with MSAA: sample groups, stored as a depth
    std::shared_ptr<const GpuBuffer> tiles{};  // deferred/lighting_tiles.h; null: a variant shades all pixels
};

// Transient image that the scene is drawn to, with the frame's samples.
ImageRef sampledImage(PassList& passes, const FrameInputs& inputs, const std::string& name, VkFormat format);
// Depth of the scene, stored as in FrameInputs::depth.
ImageRef sceneDepth(PassList& passes, const FrameInputs& inputs, const char* name = "depth");

// SET_GBUFFER of `images`. Call it when they have memory: at the latest when a pass is prepared.
DescriptorSets gbufferSet(const PassList& passes, const FrameInputs& inputs, const FrameImages& images);

// SET_GBUFFER of black texels and an empty buffer, for passes that bind TRANSPARENCY_BINDINGS to it.
DescriptorSets blendedSet(const FrameInputs& inputs);

// Estimated number of lights a pixel evaluates, including directional lights.
double lightsAtPixel(const FrameInputs& inputs);

// Formats of sums of radiance that are not the image, and of shadow maps and other reversed depths.
constexpr VkFormat litFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;

// Features shared by all draws of a frame, as listed in shared/contract/features.h.
Variant sceneVariant(const Requirements& needs, const GpuLights& lights, const View& view,
                     const GBufferLayout& gbuffer, const Settings& settings);
// Whether any pixel reads the directional albedo of the specular lobe.
bool readsSpecularAlbedo(const GpuLights& lights, const Settings& settings);

}  // namespace diptych
