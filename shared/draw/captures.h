// SPDX-License-Identifier: MIT
// Capture passes, which write channels (debug modes) to attachments.
#pragma once

#include "shared/contract/debug_mode.h"
#include "shared/vulkan/pass_list.h"
#include "shared/vulkan/pipelines.h"

#include <cstddef>
#include <span>
#include <vector>

namespace diptych {

// Where a channel stands in the images that captures draw (CAPTURES of contract/debug_mode.h).
struct PlaceInCaptures {
    gpu::uint image = 0, component = 0;  // its first component
};
PlaceInCaptures placeInCaptures(int mode);  // throws std::out_of_range

// A capture pass: up to CAPTURE_ATTACHMENTS images, in the order of CAPTURES, with all that is asked for of
// them. What no light changes is in passes of its own, unless all that light changes fits in beside it.
struct CaptureGroup {
    gpu::uint images = 0;           // a bit each: FEATURE_captures
    std::vector<VkFormat> formats;  // of each image: four float32; of lit's the frame's own
    std::vector<int> modes;         // debug modes, by image
};
// `lit`: the format of lit, over which something may be blended. `most`: images of a group.
std::vector<CaptureGroup> captureGroups(std::span<const int> modes, VkFormat lit,
                                        std::size_t most = gpu::CAPTURE_ATTACHMENTS);

// Groups share their images' memory: each is run, and read back, before the next one runs.
struct CapturedImage {
    int mode = 0;
    ImageRef image;                // which other channels may share
    int component = 0;             // its first one there
    std::size_t pass = 0;          // the number of its group's
    bool through_gbuffer = false;  // forward+: shaded from the surface that the G-buffer would give back
    bool every_sample = false;     // asked for of every sample, not the first alone
    int sample = 0;                // with several samples a pixel
    bool before_blending = false;  // lit before something is blended over it
};

// The channels to capture. `every_sample`: those of `modes` of which MSAA gives all samples.
// `through_gbuffer`, forward+ only: lit channels of surfaces that went through the G-buffer's encoding, which
// deferred has to show.
struct CaptureRequest {
    std::vector<int> modes, every_sample, through_gbuffer;
};

// Adds the group's images to the list's last pass, cleared to what the background holds (0; material_id -1).
// `lit`: the image that its lit goes on from, if there is one. `samples`: of each. `every_sample`: of
// CaptureRequest. Returns a row for each channel, those of an image one after the other.
std::vector<CapturedImage> addCaptureImages(PassList& passes, Pass& pass, const CaptureGroup& group,
                                            ImageRef lit = {},
                                            VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT,
                                            std::span<const int> every_sample = {});

}  // namespace diptych
