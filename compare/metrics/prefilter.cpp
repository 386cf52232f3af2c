// SPDX-License-Identifier: MIT
#include "compare/metrics/prefilter.h"

#include "compare/metrics/pixel.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace diptych::metrics {
namespace {

// Weighted sums along rows (dx 1) or columns (dy 1).
Image convolved(const Image& in, const std::vector<float>& weights, int dx, int dy) {
    const int radius = static_cast<int>(weights.size()) - 1;
    Image out(in.width, in.height, in.components);
    tbb::parallel_for(0, in.height, [&](int y) {
        for (int x = 0; x < in.width; ++x) {
            float* const sum = &out.at(x, y);
            for (int k = -radius; k <= radius; ++k) {
                const int sx = x + k * dx, sy = y + k * dy;
                if (sx < 0 || sy < 0 || sx >= in.width || sy >= in.height) continue;
                const float w = weights[static_cast<std::size_t>(std::abs(k))];
                for (int c = 0; c < in.components; ++c) sum[c] += w * in.at(sx, sy, c);
            }
        }
    });
    return out;
}

}  // namespace

Image blurred(const Image& image, double radius) {
    if (!(radius > 0)) return image;
    std::vector<float> weights;
    for (int k = 0; k <= static_cast<int>(std::ceil(3 * radius)); ++k)
        weights.push_back(static_cast<float>(std::exp(-0.5 * k * k / (radius * radius))));
    // An extra last component sums the weights.
    Image counted(image.width, image.height, image.components + 1);
    for (std::size_t i = 0; i < image.pixels(); ++i)
        if (finite(image.pixel(i), image.components)) {
            std::copy_n(image.pixel(i), image.components, counted.pixel(i));
            counted.pixel(i)[image.components] = 1;
        }
    counted = convolved(convolved(counted, weights, 1, 0), weights, 0, 1);
    Image result = image;
    for (std::size_t i = 0; i < image.pixels(); ++i)
        if (finite(image.pixel(i), image.components))
            for (int c = 0; c < image.components; ++c)
                result.pixel(i)[c] = counted.pixel(i)[c] / counted.pixel(i)[image.components];
    return result;
}

Image shifted(const Image& reference, const Image& test, int radius) {
    if (radius <= 0) return test;
    // Closest first, so that the smallest shift wins ties.
    struct Step {
        int x, y;
    };
    std::vector<Step> steps;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) steps.push_back({x, y});
    std::ranges::stable_sort(steps, {}, [](const Step& s) { return s.x * s.x + s.y * s.y; });
    Image result(test.width, test.height, test.components);
    tbb::parallel_for(0, test.height, [&](int y) {
        for (int x = 0; x < test.width; ++x) {
            const float* const wanted = &reference.data[reference.offset(x, y)];
            const float* best = &test.data[test.offset(x, y)];
            double min = distance(best, wanted, test.components);
            for (const Step& step : steps) {
                const int sx = x + step.x, sy = y + step.y;
                if (min == 0 || sx < 0 || sy < 0 || sx >= test.width || sy >= test.height) continue;
                const float* const p = &test.data[test.offset(sx, sy)];
                const double d = distance(p, wanted, test.components);
                if (d < min) {
                    min = d;
                    best = p;
                }
            }
            std::copy_n(best, test.components, &result.at(x, y));
        }
    });
    return result;
}

}  // namespace diptych::metrics
