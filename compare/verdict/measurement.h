// SPDX-License-Identifier: MIT
// All metrics between two images of one channel, computed on demand.
#pragma once

#include "compare/metrics/flip.h"
#include "compare/metrics/standard.h"
#include "compare/verdict/rules.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image_rows.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Two images of one channel, of equal size and components. They must outlive their Measurement.
struct ChannelPair {
    ErrorKind error_kind =
        ErrorKind::absolute;  // of max, mean, rmse, p99, p999 and the fraction of failing pixels
    ChannelKind kind = ChannelKind::color;
    bool display = false;  // sRGB values in [0, 1]; else linear
    ImageRows reference, test;
    const Coverage* coverage = nullptr;
    const ChannelStats* stats = nullptr;             // if known already
    HdrFlipOptions flip = {};                        // `covered` is set by Measurement
    std::optional<double> approximation_error = {};  // of lit; meanApproximationError()
};

class Measurement {
public:
    explicit Measurement(const ChannelPair& pair) : pair_(pair) {}

    // Empty if the metric is undefined: flip and ssim need colours, angles need vectors.
    std::optional<double> operator()(const Quantity& quantity) const;

    // All defined metrics, in the table's order.
    std::vector<std::pair<std::string, double>> all() const;

    // Covered pixels whose error in the channel's error kind exceeds `most` (NaN against a number always
    // does).
    std::uint64_t pixelsAbove(double max) const;

    double fractionOf(std::uint64_t pixels) const;  // fraction of the covered pixels, 0 to 1

    std::optional<double> approximationError() const { return pair_.approximation_error; }
    bool isVector() const;  // whether it has 3 components
    // The pair's statistics. If computed here, mean and rmse of an absolute error are over components, as
    // in other programs.
    const ChannelStats& stats() const;
    const StandardMetrics& plain() const;
    const HdrFlipResult* flip() const;  // nullptr if undefined
    // Pixels of light that FLIP and SSIM cannot see and that differ (FlipResult::unseen_different).
    std::uint64_t unseenDifferent() const;
    // FLIP's error map, which may outlive this object; nullptr if undefined.
    std::shared_ptr<const Image> flipErrors() const;

private:
    Image withHoles(const ImageRows& image) const;

    ChannelPair pair_;
    mutable std::optional<ChannelStats> stats_;
    mutable std::optional<StandardMetrics> plain_;
    mutable std::shared_ptr<HdrFlipResult> flip_;
};

// Applies the rule to the measurement. Some metrics (a mean, FLIP, SSIM) do not show a NaN or infinity
// against another value. Such a pixel always fails, unless the rule allows a fraction of failing pixels,
// where it counts as one. So does a pixel that SSIM cannot see, by a rule on SSIM. The decision's criterion
// includes its pixels.
Decision decide(const Rule& rule, const Measurement& measurement);

}  // namespace diptych
