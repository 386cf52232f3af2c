// SPDX-License-Identifier: MIT
// Estimates the host memory that Frames need, before anything is rendered.
#pragma once

#include "compare/frames/render_options.h"
#include "shared/frame/settings.h"
#include "shared/image/free_memory.h"
#include "shared/scene/scene_view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace diptych {

// Shadow maps of the sun, bytes; 0 without shadows.
double shadowBytes(const Settings& settings);

// Peak host memory, bytes, while rendering one Frame of each Settings in turn, beyond the loaded scene's.
// Includes images, and for a CPU device (`software`) its images and pipelines. Measured on lavapipe 22.3:
// 0.7 to 1.5 times the actual use (MEASURED.md). `sun`: whether a directional light may cast shadows.
// `materials`: number in the scene.
std::uint64_t hostMemory(std::span<const Settings> settings, const RenderOptions& options, bool software,
                         bool sun, std::size_t materials);

// Returns hostMemory(). Throws std::runtime_error if it exceeds both `approved` and the memory that this
// process may still use. The message states the need, the free memory and remedies: "builtin:gallery at
// 16384x16384: needs about 79.3 GB, ...".
std::uint64_t checkHostMemory(
    SceneViews& views, std::span<const Settings> settings, const RenderOptions& options, bool software,
    std::uint64_t approved = 0, const std::function<FreeMemory()>& free = [] { return freeMemory(); });

}  // namespace diptych
