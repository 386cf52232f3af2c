// SPDX-License-Identifier: MIT
// From a scene and Settings to Frames, on one device.
#pragma once

#include "shared/frame/frame.h"
#include "shared/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace diptych {

class Device;

struct RenderOptions {
    std::vector<int> channels;  // debug modes; a forward-only one is left out of a deferred Frame
    int runs = 5;               // timed frames; 0: no times, no profile
    bool through_gbuffer = false;  // forward+: also lit through the G-buffer's encoding
};

// One Frame per Settings, in order. Everything is uploaded once for all of them and every pipeline is
// compiled once. Throws std::runtime_error: one line.
std::vector<Frame> renderAll(Device& device, const Scene& scene, const std::vector<Settings>& settings,
                             const RenderOptions& options);

}  // namespace diptych
