// SPDX-License-Identifier: MIT
// NaN and infinity in rendered images: counts them, replaces them by finite values, and records in the Frame
// which pixels were replaced. Renderers call replaceNonfinite() on every image that they read back; errors,
// metrics and PNG files then only see finite values. Images from files are not replaced.
#pragma once

#include "shared/frame/frame.h"
#include "shared/image/image.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// Pixels with a component that is NaN or infinite.
std::uint64_t nonfinitePixels(const Image& image);

// Replaces NaN by 0 and infinities by the largest float32 of their sign. Returns the indices of
// these pixels.
std::vector<std::uint32_t> replaceNonfinite(Image& image);

// Adds the replaced pixels of one image of a channel: of any sample, through the G-buffer, or before
// blending.
void recordNonfinite(Frame& frame, Channel channel, const std::vector<std::uint32_t>& pixels);

// One line for each channel with replaced pixels: "lit was NaN or infinite at 3 pixels, the first at 4,2:
// ...".
std::vector<std::string> nonfiniteText(const Frame& frame);

}  // namespace diptych
