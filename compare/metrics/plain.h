// SPDX-License-Identifier: MIT
// The figures that other programs compute of two pictures: numerical errors, without a model of the eye
// except SSIM's.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/image/picture_rows.h"

#include <cstdint>
#include <optional>

namespace diptych {

// Whether a picture holds sRGB values in [0, 1] or linear radiance without an upper limit.
enum class Range { display, linear };

// r: reference, t: test; N: components of covered pixels, or, for figures of pixels, covered pixels. All 0
// where nothing is covered. A component that is nonfinite and not the same in both is an infinite difference:
// every figure that it enters becomes infinite (PSNR minus infinity), and the pixel is counted.
struct PlainMetrics {
    // Over components.
    double mse = 0, rmse = 0;  // 1/N sum (t-r)^2, and its root
    double mae = 0;            // 1/N sum |t-r|
    double relative_mse = 0;   // 1/N sum (t-r)^2 / (r^2 + 0.01): Rousselle, Knaus and Zwicker 2011, "Adaptive
                               // Sampling and Reconstruction using Greedy Error Minimization"
    double psnr = 0;           // 10 log10(peak^2 / mse), dB; infinite where mse is 0
    double peak = 1;           // Range::display: 1; linear: the reference's largest covered finite component
    double ulp_mean = 0, ulp_max = 0;  // how many float32 values lie from one to the other; -0 and 0 are one

    // Over pixels: |t-r| / max(|r|, 1e-3 mean), |.| the pixel's largest component, mean as in PixelError.
    // Percentiles are the nearest rank, to a float's rounding.
    double relative_max = 0, relative_mean = 0, relative_p99 = 0, relative_p999 = 0;
    // Degrees; for ChannelKind::vector of 3 components, else 0.
    double angle_max = 0, angle_mean = 0;
    double length_max = 0;  // | |t| - |r| |, likewise

    // Wang, Bovik, Sheikh and Simoncelli 2004, "Image Quality Assessment: From Error Visibility to Structural
    // Similarity": windows of 11x11, Gaussian of deviation 1.5, K1 0.01, K2 0.03, L 1; the mean over windows
    // that lie within the picture, whose middle is covered and all of whose pixels are finite in both. Only
    // for ChannelKind::color of 3 components; none where no such window is. Of display values: of luma,
    // 0.2126 R + 0.7152 G + 0.0722 B. Of linear values, which have no L: of the sRGB value of s Y / (1 + s
    // Y), s = 0.18 over the reference's mean luminance Y, the same for both (Reinhard et al. 2002), negative
    // as 0; s = 1 where the reference is black.
    std::optional<double> ssim;

    std::uint64_t pixels = 0;                                   // covered
    std::uint64_t different = 0;                                // covered pixels with |t-r| not 0
    std::uint64_t nonfinite_different = 0;                      // covered pixels with an infinite difference
    std::uint64_t nonfinite_reference = 0, nonfinite_test = 0;  // pixels, covered or not, the same or not
};

// Of two pictures alike in size and components (throws std::runtime_error otherwise). A few passes over the
// pixels, each in memory for a few dozen rows a thread; the same result whatever the number of threads.
PlainMetrics plainMetrics(const PictureRows& reference, const PictureRows& test, ChannelKind kind,
                          Range range, const Coverage& coverage);

}  // namespace diptych
