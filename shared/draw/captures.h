// SPDX-License-Identifier: MIT
// Capture passes, which write channels (debug modes) to attachments.
#pragma once

#include "shared/contract/debug_mode.h"
#include "shared/contract/gbuffer.h"
#include "shared/frame/channel.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <cstddef>
#include <span>
#include <vector>

namespace diptych {

// Position of a channel in the images of captures (CAPTURES of contract/debug_mode.h).
struct CaptureIndex {
    gpu::uint image = 0, component = 0;  // of its first component
};
CaptureIndex captureIndex(Channel mode);  // throws std::out_of_range

// A capture pass: up to MAX_COLOR_ATTACHMENTS images, in the order of CAPTURES, with all requested channels
// in them. Channels that do not depend on light have passes of their own, unless all lit channels fit in
// beside them.
struct CaptureGroup {
    gpu::uint images = 0;           // bit mask
    std::vector<VkFormat> formats;  // by image: RGBA32F; for lit the frame's own
    std::vector<Channel> modes;     // by image
    bool unlit = false;             // of lit images only shadow_visibility: no light is evaluated

    gpu::uint feature() const { return unlit ? images | gpu::CAPTURES_UNLIT : images; }
};
// `lit`: format of lit, over which surfaces may be blended. `max`: images in a group.
std::vector<CaptureGroup> captureGroups(std::span<const Channel> modes, VkFormat lit,
                                        std::size_t max = gpu::MAX_COLOR_ATTACHMENTS);

// Groups share the memory of their images: each is run and read back before the next one runs.
struct CapturedImage {
    Channel mode = Channel::lit;
    ImageRef image;                // other channels may share it
    int component = 0;             // its first component in the image
    std::size_t pass = 0;          // index of its group's pass
    bool through_gbuffer = false;  // forward+: shaded from the surface after the G-buffer's encoding
    bool every_sample = false;     // MSAA: capture every sample
    int sample = 0;                // MSAA: index
    bool before_blending = false;  // lit before blending
};

// Channels to capture. `every_sample`: those of `modes` that need all samples of MSAA. `through_gbuffer`,
// forward+ only: lit channels of surfaces after the G-buffer's encoding, which deferred must equal.
struct CaptureRequest {
    std::vector<Channel> modes, every_sample, through_gbuffer;
};

// Adds the group's images to the list's last pass, cleared to the background (0; material_id -1). `lit`:
// existing image that lit continues from, if any. `samples`: per pixel. `every_sample`: as in
// CaptureRequest. Returns an entry for each channel, grouped by image.
std::vector<CapturedImage> addCaptureImages(PassList& passes, Pass& pass, const CaptureGroup& group,
                                            ImageRef lit = {},
                                            VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT,
                                            std::span<const Channel> every_sample = {});

}  // namespace diptych
