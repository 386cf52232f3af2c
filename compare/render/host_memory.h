// SPDX-License-Identifier: MIT
// How much of this machine's memory Frames take, estimated before anything is drawn.
#pragma once

#include "compare/render/render_options.h"
#include "shared/frame/settings.h"
#include "shared/image/free_memory.h"
#include "shared/scene/scene_view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace diptych {

// Bytes of host memory at the peak of drawing one Frame of each Settings after the other, beyond what the
// process has once the scene is read: pictures, and where the device is a CPU (`software`) its images and
// pipelines. Measured on lavapipe 22.3: 0.7 to 1.5 times what commands take (MEASURED.md). `sun`: whether
// one may cast shadows. `materials`: of the scene.
std::uint64_t hostMemory(std::span<const Settings> settings, const RenderOptions& options, bool software,
                         bool sun, std::size_t materials);

// Returns hostMemory(). Throws std::runtime_error where that is more than `granted` and more than this
// process may still take; the message says what is needed, what is free and what helps: "builtin:gallery at
// 16384x16384: needs about 79.3 GB, ...". Draws nothing.
std::uint64_t checkHostMemory(
    SceneViews& views, std::span<const Settings> settings, const RenderOptions& options, bool software,
    std::uint64_t granted = 0, const std::function<FreeMemory()>& free = [] { return freeMemory(); });

}  // namespace diptych
