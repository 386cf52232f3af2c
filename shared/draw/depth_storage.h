// SPDX-License-Identifier: MIT
// What the scene is drawn to: how depth is stored, and what holds radiance.
#pragma once

#include "shared/contract/view.h"
#include "shared/frame/settings.h"
#include "shared/vulkan/pass.h"
#include "shared/vulkan/pipelines.h"

#include <optional>
#include <string>

namespace diptych {

class Device;

// How the depth of the scene's nearest surfaces is stored. Code and shaders compute with reversed depths and
// make their keys for them; stored() turns a key into one for the image.
struct DepthStorage {
    VkFormat format = VK_FORMAT_D32_SFLOAT;
    gpu::uint kind = gpu::DEPTH_REVERSED;
    StoredDepths range;

    // Whether the image holds equal steps, so that a fragment's own depth is not what was stored of it.
    bool inSteps() const { return kind == gpu::DEPTH_STEPS_24 || kind == gpu::DEPTH_STEPS_16; }
    // A key whose depths are reversed, of passes that draw to or test against such an image.
    PipelineKey stored(PipelineKey key) const;
    // The image of a frame, transient with `samples` samples.
    ImageDeclaration image(const char* name, VkSampleCountFlagBits samples) const {
        return {.name = name, .format = format, .samples = samples, .depths = range};
    }
};

DepthStorage depthStorage(DepthFormat format);
VkFormat litFormatOf(LitFormat format);

// Why the device cannot draw to such images or compute so, naming the Setting; nothing where it can.
std::optional<std::string> drawingProblem(const Device& device, const Settings& settings);

}  // namespace diptych
