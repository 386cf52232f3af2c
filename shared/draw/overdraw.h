// SPDX-License-Identifier: MIT
// How often forward shading would shade a pixel without a depth pre-pass, and whether one pays.
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

// Counted by occlusion queries at the list's order and at most 320x180 pixels, where what is counted is
// scaled to `width` x `height`. Needs occlusionQueryPrecise; without it `fragments` is `covered`, both 0.
Overdraw measureOverdraw(const FrameInputs& inputs, std::uint32_t width, std::uint32_t height);

// Whether the pre-pass costs less than the shading that it saves, by the device's type and measured figures
// (README, "Many lights"), and that in words: "on: 2.1 fragments a covered pixel; ...". `lights`: evaluated
// at a pixel, about.
struct PrepassChoice {
    bool on = true;
    std::string because;
};
PrepassChoice choosePrepass(const Overdraw& overdraw, double lights, bool cpu);

}  // namespace diptych
