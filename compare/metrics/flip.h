// SPDX-License-Identifier: MIT
// Perceived difference of two images when a viewer flips between them. LDR: Andersson, Nilsson,
// Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
// Images". HDR: Andersson, Nilsson, Shirley and Akenine-Moller 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images".
#pragma once

#include "compare/metrics/flip_rows.h"
#include "shared/image/image.h"
#include "shared/image/image_rows.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace diptych {

// Pixels per degree at `distance` m from a display that is `width` m and `pixels` columns wide.
double pixelsPerDegree(double distance, double width, int pixels);

struct FlipOptions {
    double pixels_per_degree = 67.0206;  // [1, 1000]; default: 3840 columns, seen from one display width
    // Pixels that count in the statistics are not 0; empty: all.
    std::span<const std::uint8_t> covered{};
};

struct HdrFlipOptions : FlipOptions {
    ToneMapper tone_mapper = ToneMapper::aces;
    // Stops, in [-126, 126]; default: from the reference.
    std::optional<double> start_exposure, stop_exposure;
    std::optional<int> exposures;  // >= 1; default: stop - start rounded up, at least 2
};

// Statistics are over the covered pixels, except those with the same non-finite value in both images.
// Other non-finite pixels have error 1 and count. FLIP cannot see differences at pixels with a component
// outside the range (LDR [0, 1], HDR below 0), or black or white at every exposure.
struct FlipResult {
    Image error;  // W x H x 1, in [0, 1]; all pixels, covered or not
    double mean = 0, min = 0, max = 0;
    // Quantiles weighted by the error itself: the least error such that all errors up to it add up to that
    // fraction of the sum.
    double weighted_first_quartile = 0, weighted_median = 0, weighted_third_quartile = 0;
    std::uint64_t pixels = 0;  // count behind the statistics
    // Counts over all pixels, covered or not:
    std::uint64_t nonfinite_reference = 0, nonfinite_test = 0;
    std::uint64_t nonfinite_different = 0;  // non-finite in one, or in both and different
    // Finite pixels that FLIP cannot see and that differ by more than 1e-3 of the reference's mean
    // luminance: error 1. Those that differ by less have error 0.
    std::uint64_t unseen_different = 0;
};

struct HdrFlipResult : FlipResult {
    double start_exposure = 0, stop_exposure = 0;  // stops
    int exposures = 0;
};

// For both functions below: `reference` and `test` are W x H x 3. Throws std::runtime_error if sizes
// differ or an option is out of range. Non-finite pixels are excluded from all filters in both images, and
// the other weights are renormalized. The result does not depend on the number of threads.

// For sRGB, display-referred values.
FlipResult ldrFlip(const ImageRows& reference, const ImageRows& test, const FlipOptions& options = {});
// For linear radiance: the largest error over evenly spaced exposures.
HdrFlipResult hdrFlip(const ImageRows& reference, const ImageRows& test, const HdrFlipOptions& options = {});

// hdrFlip() of many tests against one reference with the same options, bitwise equal. Filters the
// reference only once, which saves nearly half of the work.
class HdrFlipAgainst {
public:
    // The reference and options.covered must outlive it. Caches 20 bytes per pixel and exposure, up to
    // `max_bytes`; the rest is recomputed for each test. Throws as hdrFlip() does.
    HdrFlipAgainst(const ImageRows& reference, const HdrFlipOptions& options,
                   std::size_t max_bytes = std::size_t{256} << 20);
    ~HdrFlipAgainst();

    HdrFlipResult operator()(const ImageRows& test) const;
    // Computes only mean and pixels.
    struct Mean {
        double mean = 0;
        std::uint64_t pixels = 0;
    };
    Mean mean(const ImageRows& test) const;

private:
    struct State;
    std::unique_ptr<const State> state_;
};

// Exposures for a reference, which map the largest and the median luminance of the finite pixels to 0.85
// (2021 paper, section 3). If more than half of the luminances are not positive, the median is that of the
// positive ones. Both are 0 if none is positive. Range [-126, 126].
struct ExposureRange {
    double start = 0, stop = 0;  // stops
};
ExposureRange exposureRange(const ImageRows& reference, ToneMapper mapper);

}  // namespace diptych
