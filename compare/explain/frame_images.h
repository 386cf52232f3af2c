// SPDX-License-Identifier: MIT
// What an explanation reads of two Frames: channels, materials, and how far two images are apart.
#pragma once

#include "shared/contract/debug_mode.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych {

// A channel by the number of its debug mode. Throws std::runtime_error, one line, where the Frame has none.
const Image& channelOf(const Frame& frame, int mode);
inline const Image& channelOf(const Frame& frame, gpu::uint mode) {
    return channelOf(frame, static_cast<int>(mode));
}

// The material that a pixel of channel material_id names, by its place in the scene; -1: none, or a file
// holds no such number.
int materialOf(const float* pixel, const Scene& scene);

// As many components, and each the same bit for bit.
bool sameBits(const Image& a, const Image& b);

// a - b of each component, W x H x 3; 0 where that is not finite.
Image differenceOf(const Image& a, const Image& b);

// Mean |a - b| of the three components of each pixel; 0 where a component is not finite.
std::vector<double> errorsOf(const Image& a, const Image& b);

// Summed in order, so that it is the same whatever the number of threads; 0 of no values.
double meanOf(const std::vector<double>& values);

}  // namespace diptych
