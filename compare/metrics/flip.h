// SPDX-License-Identifier: MIT
// How different two pictures look to a person who flips between them.
// LDR: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference
// Evaluator for Alternating Images". HDR: Andersson, Nilsson, Shirley and Akenine-Moller 2021, "Visualizing
// Errors in Rendered High Dynamic Range Images".
#pragma once

#include "compare/metrics/flip_rows.h"
#include "shared/image/image.h"
#include "shared/image/picture_rows.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace diptych {

// Pixels per degree that a viewer sees at `distance` m from a display that is `width` m and `pixels` columns
// wide.
double pixelsPerDegree(double distance, double width, int pixels);

struct FlipOptions {
    double pixels_per_degree = 67.0206;  // 3840 columns, from as far away as they are wide; in [1, 1000]
    std::span<const std::uint8_t>
        covered{};  // a pixel's statistics count where it is not 0; empty: everywhere
};

struct HdrFlipOptions : FlipOptions {
    ToneMapper tone_mapper = ToneMapper::aces;
    std::optional<double> start_exposure, stop_exposure;  // stops, in [-126, 126]; else from the reference
    std::optional<int> exposures;  // 1 or more; else stop - start rounded up, at least 2
};

// Statistics are over the covered pixels, except those where both pictures hold the same nonfinite value:
// they have no error to measure. A pixel that is nonfinite in any other way has error 1 and counts.
struct FlipResult {
    Image error;  // W x H x 1, in [0, 1]; every pixel, covered or not
    double mean = 0, min = 0, max = 0;
    // Quantiles in which each error is weighted by its own size: the least error such that all errors up to
    // it add up to that share of the sum.
    double weighted_first_quartile = 0, weighted_median = 0, weighted_third_quartile = 0;
    std::uint64_t pixels = 0;  // what the statistics are over
    // Of all pixels, covered or not:
    std::uint64_t nonfinite_reference = 0, nonfinite_test = 0;
    std::uint64_t nonfinite_different = 0;  // nonfinite in one, or in both and not the same
    std::uint64_t limited_reference = 0,
                  limited_test = 0;  // finite, with a component outside what can be shown:
                                     // LDR [0, 1], HDR below 0. Taken as the limit
};

struct HdrFlipResult : FlipResult {
    double start_exposure = 0, stop_exposure = 0;  // stops
    int exposures = 0;
};

// For both functions below: `reference` and `test` are W x H x 3, equal in size; throws std::runtime_error
// otherwise, and where an option is out of its range. Nonfinite pixels (NaN or infinity in a component) are
// left out of all filters in both pictures, and the weights of the other pixels are renormalised. The result
// does not depend on the number of threads.

// Of sRGB, display-referred values.
FlipResult ldrFlip(const PictureRows& reference, const PictureRows& test, const FlipOptions& options = {});
// Of linear radiance: the largest error over the exposures, evenly spaced.
HdrFlipResult hdrFlip(const PictureRows& reference, const PictureRows& test,
                      const HdrFlipOptions& options = {});

// hdrFlip() of any number of tests against one reference under one set of options, bit for bit: what is of
// the reference alone is filtered once, which is nearly half of the work.
class HdrFlipAgainst {
public:
    // The reference and what `options` covers must outlive it. Keeps 20 bytes a pixel and exposure, as far as
    // `most_bytes` reach; what is not kept is made for each test. Throws as hdrFlip() does.
    HdrFlipAgainst(const PictureRows& reference, const HdrFlipOptions& options,
                   std::size_t most_bytes = std::size_t{256} << 20);
    ~HdrFlipAgainst();

    HdrFlipResult operator()(const PictureRows& test) const;
    // Its mean and pixels alone.
    struct Mean {
        double mean = 0;
        std::uint64_t pixels = 0;
    };
    Mean mean(const PictureRows& test) const;

private:
    struct State;
    std::unique_ptr<const State> state_;
};

// The exposures between which a reference's parts are neither too dark nor too bright: they map the largest
// and the median luminance of the finite pixels to 0.85 (2021 paper, section 3). The median of the positive
// luminances alone where more than half are not above 0; both 0 where none is. In [-126, 126].
struct ExposureRange {
    double start = 0, stop = 0;  // stops
};
ExposureRange exposureRange(const PictureRows& reference, ToneMapper mapper);

}  // namespace diptych
