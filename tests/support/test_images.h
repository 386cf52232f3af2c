// SPDX-License-Identifier: MIT
// Small images for tests of metrics.
#pragma once

#include "shared/image/image.h"
#include "tests/support/nonfinite.h"

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace diptych {

inline Image flat(int width, int height, float r, float g, float b) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        image.pixel(i)[0] = r;
        image.pixel(i)[1] = g;
        image.pixel(i)[2] = b;
    }
    return image;
}
// 40 x 30 pixels.
inline Image grey(float v) {
    return flat(40, 30, v, v, v);
}
inline void set(Image& image, int x, int y, float v) {
    for (int c = 0; c < 3; ++c) image.at(x, y, c) = v;
}

// Independent uniform components in [low, high).
inline Image noise(int width, int height, unsigned seed, float low = 0, float high = 1) {
    Image image(width, height, 3);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(low, high);
    for (float& v : image.data) v = value(random);
    return image;
}

// One row of pixels.
inline Image rowOf(int components, PixelData values) {
    Image image(static_cast<int>(values.size()) / components, 1, components);
    image.data = std::move(values);
    return image;
}

}  // namespace diptych
