// SPDX-License-Identifier: MIT
#pragma once

#include "compare/verdict/comparison.h"
#include "shared/vulkan/device/device.h"

#include <functional>

namespace diptych::viewer {

struct DrawingOptions {
    DeviceOptions device;
    CompareOptions compare;  // rules and pixels of the verdict
    // Called from another thread whenever there is a new result.
    std::function<void()> wake;
    // For tests: called before each image; its exceptions count as the device's.
    std::function<void()> before_image{};
};

}  // namespace diptych::viewer
