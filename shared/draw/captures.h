// SPDX-License-Identifier: MIT
// Capture passes, which write channels (debug modes) to attachments.
#pragma once

#include "shared/vulkan/pass_list.h"
#include "shared/vulkan/pipelines.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

// A capture pass: up to CAPTURE_ATTACHMENTS channels. Channels that need no light come first, so that as few
// passes as the attachments allow hold them all and only the last ones shade.
struct CaptureGroup {
    std::vector<int> modes;         // debug modes, one an attachment
    std::vector<VkFormat> formats;  // float32, as wide as the channel; of lit the frame's own
    void specialise(Variant& variant) const;
};
// `lit`: the format of lit, over which something may be blended. `most`: attachments of a group.
std::vector<CaptureGroup> captureGroups(std::span<const int> modes, VkFormat lit,
                                        std::size_t most = gpu::CAPTURE_ATTACHMENTS);

// Groups share their images' memory: each is run, and read back, before the next one runs.
struct CapturedImage {
    int mode = 0;
    ImageRef image;
    std::size_t pass = 0;                   // the number of its group's
    std::optional<gpu::uint> surface = {};  // forward+: SURFACE_*, where it is not of the path's own
    bool before_blending = false;           // lit as it is before something is blended over it
};

// The channels that a capture makes: of surfaces as they are; and, forward+ only, of surfaces that went
// through the G-buffer's encoding, which the deferred path has to show, and of those that bound its effect
// (SURFACE_RAISED and all after it, in this order): `bounded`, some of `through_gbuffer`.
struct CaptureRequest {
    std::vector<int> modes, through_gbuffer, bounded;
};

// Adds the group's attachments to the list's last pass, cleared to what the background holds (0; material_id
// -1). `lit`: the image that its lit goes on from, if there is one. `samples`: of each.
std::vector<CapturedImage> addCaptureImages(PassList& passes, Pass& pass, const CaptureGroup& group,
                                            ImageRef lit = {},
                                            VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT);

}  // namespace diptych
