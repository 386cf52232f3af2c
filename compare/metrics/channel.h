// SPDX-License-Identifier: MIT
// How far two images of one channel are apart.
#pragma once

#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/image/picture_rows.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych {

// Which pixels show a surface in at least one of two Frames; the others are background and count in no
// statistic. Background is recognised by material_id = -1, or, without that channel, by depth = 0. Throws
// std::runtime_error where a channel is not of its Frame's size.
struct Coverage {
    std::vector<std::uint8_t> covered;  // 1 per pixel that counts
    std::size_t count = 0;
    bool known = false;  // false: neither channel is there, so every pixel counts
};
Coverage coverage(const Frame& a, const Frame& b);
Coverage everyPixel(std::size_t pixels);

// Whether every component of every covered pixel is 0.
bool isBlack(const PictureRows& picture, const Coverage& coverage);
// The share of the covered pixels that have a component other than 0; 0 where none is covered.
double litShare(const PictureRows& picture, const Coverage& coverage);

// Over the covered pixels, in the channel's own unit (angular: degrees); all 0 where nothing is covered.
// Every figure may be infinite: a NaN or infinity against anything else is an infinite difference, which no
// tolerance passes, and so is a difference from a baseline that is 0 everywhere (relative).
struct ChannelStats {
    double max = 0, mean = 0, rmse = 0;
    double p99 = 0, p999 = 0;        // nearest rank: the ceil(p N)-th smallest of N errors
    int worst_x = -1, worst_y = -1;  // the first pixel, row by row, that has `max`; -1: no difference
    std::uint64_t different = 0;     // pixels whose error is not 0
    std::uint64_t infinite = 0;      // pixels whose error is infinite
    std::uint64_t nonfinite_baseline = 0,
                  nonfinite_test = 0;  // pixels with a NaN or infinity, the same or not
};

// The error of a pixel in a metric. |.| is the largest absolute component.
//   relative  |a-b| / max(|b|, 1e-3 mean), mean: the baseline's mean luminance over covered finite pixels
//             (Rec.709 weights for colours, magnitude for scalars and vectors)
//   absolute  |a-b|
//   angular   atan2(|a x b|, a.b), degrees; 0 between two zero vectors, 180 where one of them is
//   exact     1 where any component differs
// Two NaNs are no difference, nor are two equal infinities.
class PixelError {
public:
    PixelError(Metric metric, ChannelKind kind, const PictureRows& baseline, const Coverage& coverage);
    double operator()(const float* test, const float* baseline) const;
    double floor() const { return floor_; }  // relative: the least denominator; otherwise 0

private:
    Metric metric_;
    int components_;
    double floor_ = 0;
};

// Statistics of `test` against `baseline`, equal in size and components (throws std::runtime_error
// otherwise). Deterministic: sums are double, in pixel order. Takes a few MB, whatever the size.
ChannelStats channelStats(Metric metric, ChannelKind kind, const PictureRows& baseline,
                          const PictureRows& test, const Coverage& coverage);

// The errors that the statistics are over, W x H x 1; 0 in the background, infinite errors are +infinity.
Image errorImage(Metric metric, ChannelKind kind, const PictureRows& baseline, const PictureRows& test,
                 const Coverage& coverage);

// Units in the last place of a pixel's largest component by which two pipelines may differ on a GPU, whose
// compiler may contract multiplications and additions differently in each.
constexpr int gpuUlps = 16;

// Pixels of all W x H, covered or not, that are not the same: bit for bit (NaN is NaN, -0 is not 0), or, with
// `ulps` > 0, further apart than that many units in the last place of the pixel's largest component.
std::uint64_t unequalPixels(const Image& a, const Image& b, int ulps);

// One pixel as a picture of 1x1; `pixel` counts row by row from 0.
Image onePixel(const Image& image, std::size_t pixel);

}  // namespace diptych
