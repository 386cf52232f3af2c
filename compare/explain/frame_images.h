// SPDX-License-Identifier: MIT
// Reads channels and materials of Frames; computes differences of images and the exposure between them.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace diptych {

// Throws std::runtime_error, one line, if the Frame lacks it.
const Image& channelOf(const Frame& frame, Channel channel);

// The first three components of a pixel.
glm::dvec3 colorAt(const Image& image, std::size_t pixel);

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

// The median ratio of `lit` to `expected`, both W x H x 3, if at least half of the components have it to
// within 0.1 %, twice the rounding of a half-float file. Components of `expected` under a thousandth of
// its mean are ignored. Empty without such a factor or without bright components.
std::optional<double> commonFactor(const Image& lit, const Image& expected);

// How many times brighter `test` is than `baseline`, from their common factors. Empty if a factor is
// missing or both are equal.
std::optional<double> exposureBetween(std::optional<double> baseline, std::optional<double> test);

}  // namespace diptych
