// SPDX-License-Identifier: MIT
#pragma once

#include "shared/vulkan/device/resources.h"

namespace diptych {

// The table of shared/light/ltc.h as shaders sample it: bilinear, clamped to its edges.
class LtcImage {
public:
    LtcImage() = default;
    // `needed`: whether a light uses it; else the image is one texel, because the binding needs an image.
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
