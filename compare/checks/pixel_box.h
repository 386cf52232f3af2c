// SPDX-License-Identifier: MIT
#pragma once

namespace diptych {

// Pixels from (x0, y0), inclusive, to (x1, y1), exclusive; the origin is at the top left.
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
    bool operator==(const PixelBox&) const = default;
};

}  // namespace diptych
