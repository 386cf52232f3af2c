// SPDX-License-Identifier: MIT
// Samples a pixel: how many a device draws, and Settings of the same picture with another number.
#pragma once

#include "shared/frame/settings.h"
#include "shared/vulkan/device.h"

#include <vector>

namespace diptych {

// Of 1, 4 and 8 those that every format has that the paths draw to, ascending. Asked of each format: a device
// may say that it has one sample of integers (framebufferIntegerColorSampleCounts) and draw more.
std::vector<int> sampleCounts(const Device& device);

// With so many samples, and the defaults of what has a meaning with several samples alone.
Settings withSamples(const Settings& settings, int samples);

}  // namespace diptych
