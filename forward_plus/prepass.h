// SPDX-License-Identifier: MIT
// Estimates how often forward shading would shade a pixel without a depth pre-pass, and whether a pre-pass
// costs less than it saves.
#pragma once

#include "shared/draw/frame_inputs.h"

#include <cstdint>
#include <string>

namespace diptych {

struct Overdraw {
    std::uint64_t triangles = 0;  // of all draw calls
    std::uint64_t fragments = 0;  // that pass the depth test in drawing order
    std::uint64_t covered = 0;    // pixels
    double textures = 0;          // average per triangle, of its material
};

// Counts with occlusion queries, in the order of the draw list, at no more than 320x180 pixels, and scales
// the counts to `width` x `height` pixels. Needs occlusionQueryPrecise; without it `fragments` and
// `covered` are 0.
Overdraw measureOverdraw(const FrameInputs& inputs, std::uint32_t width, std::uint32_t height);

// Whether the pre-pass costs less than the shading that it saves, from measurements on a CPU device
// (estimated for others). The reason: "--prepass auto is on: 2.1 fragments per covered pixel; ...".
// `lights`: estimated number of lights a pixel evaluates.
struct PrepassChoice {
    bool on = true;
    std::string because;
};
PrepassChoice choosePrepass(const Overdraw& overdraw, double lights, const DeviceProfile& device);

}  // namespace diptych
