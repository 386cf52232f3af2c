// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/pixels.h"

#include <cstddef>

namespace diptych {

// width x height x components float32 values, row 0 on top, components of a pixel adjacent.
struct Image {
    int width = 0, height = 0, components = 0;
    PixelData data;

    Image() = default;
    Image(int w, int h, int n, float value = 0.0f)
        : width(w),
          height(h),
          components(n),
          data(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(n),
               value) {}

    bool empty() const { return data.empty(); }
    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
    const float* pixel(std::size_t index) const {
        return data.data() + index * static_cast<std::size_t>(components);
    }
    float* pixel(std::size_t index) { return data.data() + index * static_cast<std::size_t>(components); }
    float& at(int x, int y, int c = 0) { return data[offset(x, y, c)]; }
    float at(int x, int y, int c = 0) const { return data[offset(x, y, c)]; }
    std::size_t offset(int x, int y, int c = 0) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(components) +
               static_cast<std::size_t>(c);
    }
};

}  // namespace diptych
