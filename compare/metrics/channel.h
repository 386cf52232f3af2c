// SPDX-License-Identifier: MIT
// Compares two images of one channel.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/image/image_rows.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace diptych {

// Pixels that show a surface in at least one of two Frames; the others are background and count in no
// statistic. Background has material_id -1 (or, without that channel, depth 0) and no blended surface in
// front. Throws std::runtime_error if a channel's size is not its Frame's.
struct Coverage {
    std::vector<std::uint8_t> covered;  // 1 for pixels that count
    std::size_t count = 0;
    bool known = false;  // false: neither channel exists, so every pixel counts
};
Coverage coverage(const Frame& a, const Frame& b);
Coverage everyPixel(std::size_t pixels);

// Whether all components of all covered pixels are 0.
bool isBlack(const ImageRows& image, const Coverage& coverage);
// Fraction of covered pixels that are not 0; 0 if none is covered.
double litFraction(const ImageRows& image, const Coverage& coverage);

// Statistics over the covered pixels, in the channel's unit (angular, axial: degrees); 0 if none is
// covered. All may be infinite: a NaN or infinity has infinite error against anything else, which no
// tolerance accepts. So has any difference from a baseline that is 0 everywhere (relative).
struct ChannelStats {
    double max = 0, mean = 0, rmse = 0;
    double p99 = 0, p999 = 0;        // nearest rank: the ceil(p N)-th smallest of N errors
    int worst_x = -1, worst_y = -1;  // first pixel in row order with `max`; -1: no difference
    std::uint64_t different = 0;     // pixels with non-zero error
    std::uint64_t infinite = 0;      // pixels with infinite error
    // Pixels with a NaN or infinity, equal or not.
    std::uint64_t nonfinite_baseline = 0, nonfinite_test = 0;

    std::array<std::pair<const char*, double>, 5> byName() const {  // names in our files
        return {{{"max", max}, {"mean", mean}, {"rmse", rmse}, {"p99", p99}, {"p999", p999}}};
    }
};

// The error of a pixel. |.| is the largest absolute component.
//   relative  |a-b| / max(|b|, 1e-3 mean), mean: the baseline's mean luminance over covered finite pixels
//             (Rec.709 weights for colours, magnitude for scalars and vectors)
//   absolute  |a-b|
//   angular   atan2(|a x b|, a.b), degrees; 0 between two zero vectors, 180 if one of them is zero
//   axial     the smaller angle of a to b and of a to -b, degrees; likewise, 90 if one of them is zero
//   exact     1 if any component differs
// Two NaNs are equal, and so are equal infinities.
class PixelError {
public:
    PixelError(ErrorKind errorKind, ChannelKind kind, const ImageRows& baseline, const Coverage& coverage);
    double operator()(const float* test, const float* baseline) const;
    double floor() const { return floor_; }  // relative: least denominator; else 0

private:
    ErrorKind error_kind_;
    int components_;
    double floor_ = 0;
};

// Statistics of `test` against `baseline`. Throws std::runtime_error if their sizes or components differ.
// Deterministic: sums are double, in pixel order. Takes a few MB for any size.
ChannelStats channelStats(ErrorKind errorKind, ChannelKind kind, const ImageRows& baseline,
                          const ImageRows& test, const Coverage& coverage);

// The errors behind the statistics, W x H x 1; 0 in the background, infinite errors are +infinity.
Image errorImage(ErrorKind errorKind, ChannelKind kind, const ImageRows& baseline, const ImageRows& test,
                 const Coverage& coverage);

// Tolerance in units in the last place of a pixel's largest component between two pipelines on a GPU. Its
// compiler may contract multiply-adds differently in each.
constexpr int gpuUlps = 16;

// Number of pixels of all W x H that differ. Without `ulps`, bitwise: NaN equals NaN, -0 differs from 0.
// With `ulps` > 0, by more than that many units in the last place of the pixel's largest component.
std::uint64_t unequalPixels(const Image& a, const Image& b, int ulps);

// One pixel as a 1x1 image; `pixel` is its index in row order.
Image onePixel(const Image& image, std::size_t pixel);

}  // namespace diptych
