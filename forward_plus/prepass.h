// SPDX-License-Identifier: MIT
// How often forward shading would shade a pixel without a depth pre-pass, and whether a pre-pass costs less
// than it saves.
#pragma once

#include "shared/draw/frame_inputs.h"

#include <cstdint>
#include <string>

namespace diptych {

struct Overdraw {
    std::uint64_t triangles = 0;  // of the drawn items
    std::uint64_t fragments = 0;  // that pass the depth test in drawing order
    std::uint64_t covered = 0;    // pixels
    double textures = 0;          // of a triangle's material, on average
};

// Counts by occlusion queries, in the order of the draw list, at no more than 320x180 pixels, and scales the
// counts to `width` x `height` pixels. Needs occlusionQueryPrecise; without it `fragments` is `covered`, both
// 0.
Overdraw measureOverdraw(const FrameInputs& inputs, std::uint32_t width, std::uint32_t height);

// Whether the pre-pass costs less than the shading that it saves, by figures measured on a CPU device
// (estimated for others), and the reason in words: "--prepass auto is on: 2.1 fragments per covered pixel;
// ...". `lights`: about as many as are evaluated at a pixel.
struct PrepassChoice {
    bool on = true;
    std::string because;
};
PrepassChoice choosePrepass(const Overdraw& overdraw, double lights, const DeviceProfile& device);

}  // namespace diptych
