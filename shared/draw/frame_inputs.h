// SPDX-License-Identifier: MIT
// What a path is given, and what it gives.
#pragma once

#include "shared/draw/depth_storage.h"
#include "shared/draw/draw_list.h"
#include "shared/draw/layouts.h"
#include "shared/draw/posing.h"
#include "shared/frame/settings.h"
#include "shared/material/gbuffer_layout.h"
#include "shared/vulkan/pass_list.h"

#include <array>

namespace diptych {

class Culling;
// Of rooms above this one, handed on to the paths.
class ShadowMaps;
class FragmentLists;

// One view of a scene under one Settings. What is referred to outlives it.
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
    VkBuffer sorted_indices = VK_NULL_HANDLE;  // DrawList::sorted_indices; none where those are empty
    const Culling* culling = nullptr;          // of DrawItem::chosen; none where no draw is
    VkDescriptorSet frame_set;                 // SET_FRAME
    const Placeholders& placeholders;
    LightLists& lists;
    Variant variant;  // of the scene and the view: light kinds, emission, projection, G-buffer encoding
    GBufferLayout gbuffer;
    Lighting lighting = Lighting::fragment;  // of the deferred path
    DepthStorage depth{};
    VkFormat lit_format = VK_FORMAT_R32G32B32A32_SFLOAT;  // of what a picture's radiance is drawn to
    ShadowMaps& shadow;
    Transparency transparency = Transparency::sorted;
    gpu::BlendedConstants blended{};           // of all passes of blended surfaces
    const FragmentLists* fragments = nullptr;  // Transparency::list
    gpu::uint longest_list = 0;                // packets of the longest light list that a pixel may walk
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  // of a pixel, in images that triangles draw to
    bool sample_shading = false;                            // a fragment a sample
    MsaaEdges edges = MsaaEdges::exact;
    bool alpha_to_coverage = false;  // alpha masks choose samples
    bool prepass = true;             // forward+ draws depth first; prepareForwardPlus() decides
};

// What is made before anything is drawn: which triangles may show, and posed vertices. First among a path's
// passes.
void addGeometryPasses(PassList& passes, const FrameInputs& inputs);
// Declares that the pass draws the view's items, and returns it.
Pass& readGeometry(PassList& passes, Pass& pass, const FrameInputs& inputs);

struct FrameImages {
    ImageRef lit;          // linear scene-referred radiance, of FrameInputs::lit_format
    ImageRef lit_samples;  // of every sample, before the resolve
    ImageRef depth;        // as FrameInputs::depth says
    std::array<ImageRef, gpu::GBUFFER_ATTACHMENTS> gbuffer{};  // deferred; invalid where there is none
    ImageRef groups{};  // deferred, with several samples a pixel: which of them are shaded as one, as a depth
};

// A transient that the scene's triangles draw to: with all samples of the frame.
ImageRef sampledImage(PassList& passes, const FrameInputs& inputs, const std::string& name, VkFormat format);
// The depth of the scene's triangles, as FrameInputs::depth stores it.
ImageRef sceneDepth(PassList& passes, const FrameInputs& inputs, const char* name = "depth");

// SET_GBUFFER of what `images` has. Made when they have memory, once a pass is prepared at the latest.
DescriptorSets gbufferSet(const PassList& passes, const FrameInputs& inputs, const FrameImages& images);

// SET_GBUFFER of black texels and an empty buffer, for TRANSPARENCY_BINDINGS to be written to.
DescriptorSets blendedSet(const FrameInputs& inputs);

// Of local lights those that a pixel evaluates, about, and the directional ones.
double lightsAtPixel(const FrameInputs& inputs);

// Of sums of light that are no picture; of shadow maps, and of what else stores depths reversed.
constexpr VkFormat litFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;

// The features that are the same for all draws of a frame; shared/contract/features.h says which those are.
Variant sceneVariant(const Requirements& needs, const GpuLights& lights, const View& view,
                     const GBufferLayout& gbuffer, const Settings& settings);
// Whether any pixel asks what a specular lobe reflects of light from everywhere.
bool readsSpecularAlbedo(const GpuLights& lights, const Settings& settings);

}  // namespace diptych
