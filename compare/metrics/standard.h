// SPDX-License-Identifier: MIT
// Standard image metrics: numerical errors and SSIM, without FLIP's model of vision.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/image/image_rows.h"

#include <cstdint>
#include <optional>

namespace diptych {

// sRGB values in [0, 1], or linear radiance without an upper limit.
enum class Range { display, linear };

// r: reference, t: test. N counts components of covered pixels, or covered pixels for per-pixel metrics.
// All are 0 if nothing is covered. A component that is non-finite and not the same in both is an infinite
// difference. The metrics it enters become infinite (PSNR minus infinity), and its pixel is counted.
struct StandardMetrics {
    // Over components.
    double mse = 0, rmse = 0;  // 1/N sum (t-r)^2, and its root
    double mae = 0;            // 1/N sum |t-r|
    // 1/N sum (t-r)^2 / (r^2 + 0.01): Rousselle, Knaus and Zwicker 2011, "Adaptive Sampling and
    // Reconstruction using Greedy Error Minimization".
    double relative_mse = 0;
    double psnr = 0;  // 10 log10(peak^2 / mse), dB; infinite if mse is 0
    // Range::display: 1; linear: the reference's largest covered finite component.
    double peak = 1;
    double ulp_mean = 0, ulp_max = 0;  // distance in float32 values; -0 equals 0

    // Over pixels: |t-r| / max(|r|, 1e-3 mean), |.| the pixel's largest component, mean as in PixelError.
    // Percentiles use the nearest rank, up to float rounding.
    double relative_max = 0, relative_mean = 0, relative_p99 = 0, relative_p999 = 0;
    // Degrees, between lines if the error kind is axial; 0 except for ChannelKind::vector with 3 components.
    double angle_max = 0, angle_mean = 0;
    double length_max = 0;  // | |t| - |r| |; likewise

    // Wang, Bovik, Sheikh and Simoncelli 2004, "Image Quality Assessment: From Error Visibility to
    // Structural Similarity": 11x11 windows, Gaussian of standard deviation 1.5, K1 0.01, K2 0.03, L 1.
    // The mean is over windows inside the image whose centre is covered and whose pixels are all finite in
    // both. Only for ChannelKind::color with 3 components; none without such a window. Display values are
    // compared by luma, 0.2126 R + 0.7152 G + 0.0722 B. Linear values have no L: they are compared by the
    // sRGB value of s Y / (1 + s Y), negative Y as 0 (Reinhard et al. 2002). s is 0.18 over the
    // reference's mean luminance for both images, or 1 if the reference is black.
    std::optional<double> ssim;

    std::uint64_t pixels = 0;                                   // covered
    std::uint64_t different = 0;                                // covered pixels with t != r
    std::uint64_t nonfinite_different = 0;                      // covered pixels with infinite difference
    std::uint64_t nonfinite_reference = 0, nonfinite_test = 0;  // pixels, covered or not, equal or not
};

// Compares two images; throws std::runtime_error if their sizes or components differ. Makes a few passes
// over the pixels, each with a few dozen rows per thread. The result does not depend on the number of
// threads.
StandardMetrics standardMetrics(const ImageRows& reference, const ImageRows& test, ChannelKind kind,
                                Range range, const Coverage& coverage,
                                ErrorKind errorKind = ErrorKind::angular);

}  // namespace diptych
