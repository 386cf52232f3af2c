// SPDX-License-Identifier: MIT
// Storage formats of the scene's depth and radiance.
#pragma once

#include "shared/contract/view.h"
#include "shared/frame/settings.h"
#include "shared/vulkan/passes/pass.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <optional>
#include <string>

namespace diptych {

class Device;

// Storage of the scene's depth. Code, shaders and their pipeline keys use reversed depth; stored()
// converts a key for the image.
struct DepthStorage {
    VkFormat format = VK_FORMAT_D32_SFLOAT;
    gpu::uint kind = gpu::DEPTH_REVERSED;
    StoredDepths range;

    // Whether the image quantizes depth, so that a fragment's own depth differs from the stored one.
    bool inSteps() const { return kind == gpu::DEPTH_STEPS_24 || kind == gpu::DEPTH_STEPS_16; }
    // Converts a key with reversed depth, of passes that write or test such an image.
    PipelineKey stored(PipelineKey key) const;
    // Declaration of a frame's transient image.
    ImageDeclaration image(const char* name, VkSampleCountFlagBits samples) const {
        return {.name = name, .format = format, .samples = samples, .depths = range};
    }
};

DepthStorage depthStorage(DepthFormat format);
VkFormat litFormatOf(LitFormat format);

// Why the device does not support such images or shading, naming the setting; nothing if it does.
std::optional<std::string> drawingProblem(const Device& device, const Settings& settings);

}  // namespace diptych
