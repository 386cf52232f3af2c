// SPDX-License-Identifier: MIT
// Reads channels and materials of Frames, and computes differences of images.
#pragma once

#include "shared/contract/debug_mode.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <vector>

namespace diptych {

// Throws std::runtime_error, one line, if the Frame lacks it.
const Image& channelOf(const Frame& frame, Channel mode);

// The scene index of the material in a pixel of channel material_id; -1: none, or an invalid number from a
// file.
int materialOf(const float* pixel, const Scene& scene);

// Whether component counts and all bits are equal.
bool sameBits(const Image& a, const Image& b);

// a - b for each component, W x H x 3; 0 where not finite.
Image differenceOf(const Image& a, const Image& b);

// Mean |a - b| of the three components of each pixel; 0 where a component is not finite.
std::vector<double> errorsOf(const Image& a, const Image& b);

// Summed in order, so that the result does not depend on the number of threads; 0 for no values.
double meanOf(const std::vector<double>& values);

}  // namespace diptych
