// SPDX-License-Identifier: MIT
// Sample counts that a device supports, and Settings of the same image with another count.
#pragma once

#include "shared/frame/settings.h"
#include "shared/vulkan/device/device.h"

#include <vector>

namespace diptych {

// The counts among 1, 4 and 8 that every render target format supports, ascending. Asks for each format: a
// device may report one sample for integers (framebufferIntegerColorSampleCounts) and support more.
std::vector<int> sampleCounts(const Device& device);

// Sets the sample count, and the defaults of settings that need MSAA.
Settings withSamples(const Settings& settings, int samples);

}  // namespace diptych
