// SPDX-License-Identifier: MIT
#include "compare/metrics/ssim.h"

#include "compare/metrics/convolve.h"
#include "compare/metrics/fast_math.h"
#include "compare/metrics/pixel.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace diptych::metrics {
namespace {

constexpr int radius = 5;
constexpr int bandHeight = 16;              // rows whose similarities are summed first
constexpr int taskHeight = 4 * bandHeight;  // rows per task; the planes also have the windows' borders
constexpr float c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;  // (K L)^2

std::array<float, radius + 1> window() {
    std::array<double, radius + 1> w{};
    double sum = 0;
    for (unsigned k = 0; k <= radius; ++k) {
        w[k] = std::exp(-0.5 * (k / 1.5) * (k / 1.5));
        sum += (k ? 2 : 1) * w[k];
    }
    std::array<float, radius + 1> normalised{};
    std::ranges::transform(w, normalised.begin(), [&](double v) { return static_cast<float>(v / sum); });
    return normalised;
}

// Sum and difference of the two images, and their squares. Variances and covariance then need four filters
// instead of five.
struct Moments {
    float *sum, *difference, *sum2, *difference2;
};

DIPTYCH_WIDE_LANES void momentsOf(const float* __restrict a, const float* __restrict b, const Moments m,
                                  int n) {
    for (int i = 0; i < n; ++i) {
        const float s = a[i] + b[i], d = a[i] - b[i];
        m.sum[i] = s;
        m.difference[i] = d;
        m.sum2[i] = s * s;
        m.difference2[i] = d * d;
    }
}

// With s = a + b and d = a - b: 2 mean a mean b = (s^2 - d^2) / 2, mean a^2 + mean b^2 = (s^2 + d^2) / 2;
// likewise for variances. Two equal images have exactly 1.
DIPTYCH_WIDE_LANES void similarities(float* __restrict out, const Moments m, int n) {
    for (int i = 0; i < n; ++i) {
        const float s2 = m.sum[i] * m.sum[i], d2 = m.difference[i] * m.difference[i];
        const float vs = m.sum2[i] - s2, vd = m.difference2[i] - d2;
        out[i] = (0.5f * (s2 - d2) + c1) * (0.5f * (vs - vd) + c2) /
                 ((0.5f * (s2 + d2) + c1) * (0.5f * (vs + vd) + c2));
    }
}

struct Sum {
    double value = 0;
    std::uint64_t count = 0;
};

// Windows with centres in rows [from, to).
class Band {
public:
    // `reference` and `test`: row from - radius of the planes; the other rows follow.
    Band(const float* reference, const float* test, int width, int from, int to)
        : width_(width),
          from_(from),
          rows_(to - from + 2 * radius),
          planes_(size(4 * rows_) * size(width_)),
          upright_(size(width_)),
          filtered_(size(4 * width_)) {
        for (int y = 0; y < rows_; ++y) {
            const std::size_t at = size(y) * size(width);
            momentsOf(reference + at, test + at, {row(y, 0), row(y, 1), row(y, 2), row(y, 3)}, width_);
        }
    }

    Sum sum(int y, std::span<const std::uint8_t> covered) {
        const int n = width_ - 2 * radius;
        for (int plane = 0; plane < 4; ++plane) filter(y, plane, filtered_.data() + plane * width_);
        float* out = upright_.data();
        similarities(out,
                     {filtered_.data(), filtered_.data() + width_, filtered_.data() + 2 * width_,
                      filtered_.data() + 3 * width_},
                     n);
        const std::uint8_t* counts = covered.data() + size(y) * size(width_) + radius;
        Sum total;
        for (int i = 0; i < n; ++i)
            if (counts[i] && !std::isnan(out[i])) {
                total.value += double{out[i]};
                ++total.count;
            }
        return total;
    }

private:
    float* row(int y, int plane) { return planes_.data() + size(4 * y + plane) * size(width_); }

    void filter(int y, int plane, float* out) {
        static const std::array<float, radius + 1> weights = window();
        const float* taps[2 * radius + 1];
        for (int k = 0; k <= 2 * radius; ++k) taps[k] = row(y - from_ + k, plane);
        convolveEven(upright_.data(), taps + radius, weights.data(), radius, width_);
        for (int k = 0; k <= 2 * radius; ++k) taps[k] = upright_.data() + k;
        convolveEven(out, taps + radius, weights.data(), radius, width_ - 2 * radius);
    }

    int width_, from_, rows_;
    std::vector<float> planes_, upright_, filtered_;
};

}  // namespace

std::optional<double> ssim(int width, int height, const PlaneRow& reference, const PlaneRow& test,
                           std::span<const std::uint8_t> covered) {
    if (size(width) * size(height) != covered.size())
        throw std::runtime_error(fmt::format("SSIM of {}x{} pixels: {} coverage values; give one per pixel",
                                             width, height, covered.size()));
    const int first = radius, last = height - radius;  // rows of centres
    if (first >= last || width <= 2 * radius) return {};
    std::vector<Sum> bands(size((last - first + bandHeight - 1) / bandHeight));
    tbb::parallel_for(0, (last - first + taskHeight - 1) / taskHeight, [&](int task) {
        const int top = first + task * taskHeight, bottom = std::min(top + taskHeight, last);
        const std::size_t plane = size(bottom - top + 2 * radius) * size(width);
        std::vector<float> a(plane), b(plane);
        for (int y = top - radius; y < bottom + radius; ++y) {
            const std::size_t at = size(y - top + radius) * size(width);
            reference(a.data() + at, y);
            test(b.data() + at, y);
        }
        for (int from = top; from < bottom; from += bandHeight) {
            const int to = std::min(from + bandHeight, bottom);
            const std::size_t at = size(from - top) * size(width);
            Band band(a.data() + at, b.data() + at, width, from, to);
            Sum& sum = bands[size((from - first) / bandHeight)];
            for (int y = from; y < to; ++y) {
                const Sum row = band.sum(y, covered);
                sum.value += row.value;
                sum.count += row.count;
            }
        }
    });
    Sum total;
    for (const Sum& band : bands) {
        total.value += band.value;
        total.count += band.count;
    }
    if (total.count == 0) return {};
    return total.value / static_cast<double>(total.count);
}

}  // namespace diptych::metrics
