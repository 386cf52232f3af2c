// SPDX-License-Identifier: MIT
// Differences of lit that only appear after something is blended over the opaque image.
#pragma once

#include "compare/verdict/frame_pair.h"

#include <cstdint>
#include <optional>
#include <string>

namespace diptych {

struct AfterBlending {
    std::uint64_t covered = 0;  // compared pixels with blended surfaces
    std::uint64_t before = 0;   // pixels whose lit differs before blending
    std::uint64_t pixels = 0;   // pixels that differ after it and did not, or less, before
    std::uint64_t allowed = 0;  // permitted number of such pixels
    double largest = 0;         // their largest difference after it, in lit's error kind
    int x = -1, y = -1;         // its pixel

    bool passed() const { return pixels <= allowed; }
};

// Two paths: blending "over" weights the background by 0 to 1 and both blend the same, so no pixel may
// differ more than before. On a CPU, equal pixels must stay bitwise equal; else 16 ULP of the pixel's
// largest component are added, because both sums are rounded. With a packed G-buffer, forward+'s image
// after the encoding is used, so differences that the encoding explains do not count.
// A path and the reference in mode surface: counts pixels within lit's tolerance before and out of it
// after. A thousandth of the blended pixels may be, rounded up.
// Empty if nothing is blended, or if the image before blending is unknown.
std::optional<AfterBlending> afterBlending(const FramePair& pair);

// "after the transparent draw: 132 pixels of lit differ that did not before it ..."; empty if it passed.
std::string faultOf(const AfterBlending& found);

}  // namespace diptych
