// SPDX-License-Identifier: MIT
// What two Frames are judged with.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/frame/frame.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/requirements.h"

#include <string_view>

namespace diptych {

struct AcrossDevices;  // across_devices.h
class SurfaceGrid;     // surface_grid.h

// Two Frames of one scene and camera, the device they were drawn on, and what the scene needs.
struct FramePair {
    const Frame& baseline;
    const Frame& test;
    const Requirements& needs;
    const Coverage& coverage;
    bool cpu = true;  // a CPU device rounds alike in every pipeline; a GPU is granted gpuUlps
    // In a comparison with the reference: the Frame of forward+ of the same view and Settings that has
    // through_gbuffer; or nullptr.
    const Frame* explaining = nullptr;

    // Against a reference in mode scene: what the device makes of texels of 8 bits, where the scene has
    // textures.
    const TextureSampling* texels = nullptr;

    // One path on two devices, with its neighbours; else nullptr.
    const AcrossDevices* across = nullptr;
    const SurfaceGrid* grid = nullptr;

    // As CompareOptions::light_differs; empty: both are lit alike.
    std::string_view light_differs = {};

    const Frame* of(Path path) const;  // nullptr: neither, or both
};

// Whether one of the two is of the reference and the other one of a path.
bool isPathAgainstReference(const FramePair& pair);

}  // namespace diptych
