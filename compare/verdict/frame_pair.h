// SPDX-License-Identifier: MIT
// Two Frames and everything needed to compare them.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/frame/frame.h"
#include "shared/material/texture_probe.h"
#include "shared/scene/requirements.h"

#include <string_view>

namespace diptych {

struct AcrossDevices;  // across_devices.h
class SurfaceGrid;     // surface_grid.h

// Whether a path with these Settings stores surfaces in fewer bits than float32.
inline bool isPacked(const Settings& settings) {
    return hasGBuffer(settings.path) && settings.gbuffer != GBufferEncoding::full;
}

// Two Frames of one scene and camera, the device that rendered them, and the scene's requirements.
struct FramePair {
    const Frame& baseline;
    const Frame& test;
    const Requirements& needs;
    const Coverage& coverage;
    bool cpu = true;  // a CPU device rounds alike in every pipeline; a GPU has gpuUlps
    // Comparison with the reference: the Frame of forward+ with through_gbuffer, for the same view and
    // Settings; or nullptr.
    const Frame* explaining = nullptr;

    // Against a reference in mode scene: the device's 8-bit texel sampling, if the scene has textures.
    const TextureSampling* texels = nullptr;

    // One path on two devices, and its neighbours; else nullptr.
    const AcrossDevices* across = nullptr;
    const SurfaceGrid* grid = nullptr;

    // As CompareOptions::light_differs; empty: equal lighting.
    std::string_view light_differs = {};

    // The side whose path can do it (hasGBuffer, shadesFragments); nullptr: neither, or both.
    const Frame* of(bool (*can)(Path)) const {
        const bool first = can(baseline.settings.path), second = can(test.settings.path);
        return first == second ? nullptr : first ? &baseline : &test;
    }

    // Whether one side alone is the reference; that side, and the other.
    bool hasReference() const { return isReferenceFrame(baseline) != isReferenceFrame(test); }
    const Frame& reference() const { return isReferenceFrame(baseline) ? baseline : test; }
    const Frame& path() const { return isReferenceFrame(baseline) ? test : baseline; }
};

// Whether one side is the reference and the other a path.
inline bool isPathAgainstReference(const FramePair& pair) {
    return pair.hasReference() && !pair.baseline.origin.external && !pair.test.origin.external;
}

}  // namespace diptych
