// SPDX-License-Identifier: MIT
#pragma once

#include "shared/vulkan/resources.h"

namespace diptych {

// The table of shared/light/ltc.h as the shaders sample it: bilinear, kept at its edges.
class LtcImage {
public:
    LtcImage() = default;
    // `needed`: some light is shaded with it; else it is one texel, because a binding must hold an image.
    // Uploaded when `uploader` is flushed.
    LtcImage(Device& device, Uploader& uploader, bool needed);

    VkImageView view() const { return image_.view(); }
    VkSampler sampler() const { return sampler_; }
    VkDeviceSize bytes() const { return image_.bytes(); }

private:
    GpuImage image_;
    OwnedSampler sampler_;
};

}  // namespace diptych
