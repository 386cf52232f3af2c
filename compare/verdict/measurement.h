// SPDX-License-Identifier: MIT
// Every figure of two images of one channel, each computed on demand.
#pragma once

#include "compare/metrics/flip.h"
#include "compare/metrics/standard.h"
#include "compare/verdict/rules.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/picture_rows.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Two pictures of one channel, equal in size and components. They must outlive their Measurement.
struct ChannelPair {
    Metric metric = Metric::absolute;  // of max, mean, rmse, p99, p999 and the share of failing pixels
    ChannelKind kind = ChannelKind::color;
    bool display = false;  // sRGB values in [0, 1]; else linear
    PictureRows reference, test;
    const Coverage* coverage = nullptr;
    const ChannelStats* stats = nullptr;  // where they are known already
    HdrFlipOptions flip = {};             // its `covered` is set here
};

class Measurement {
public:
    explicit Measurement(const ChannelPair& pair) : pair_(pair) {}

    // Empty where a figure is not defined: flip and ssim need colours, angles need vectors.
    std::optional<double> operator()(const Quantity& quantity) const;
    Measured asMeasured() const;  // a function that measures by this object, which must outlive it

    // All that are defined, in the table's order.
    std::vector<std::pair<std::string, double>> all() const;

    // Covered pixels whose error in the channel's metric is above `most` (a NaN against a number always is).
    std::uint64_t pixelsAbove(double most) const;

    double shareOf(std::uint64_t pixels) const;  // of the covered ones, 0 to 1

    bool isVector() const;  // of 3 components
    // The statistics given in the pair. If computed here, mean and rmse of an absolute error are over
    // components, as in other programs.
    const ChannelStats& stats() const;
    const StandardMetrics& plain() const;
    const HdrFlipResult* flip() const;  // nullptr where it is not defined
    // FLIP's error map, which may outlive this object; nullptr where it is not defined.
    std::shared_ptr<const Image> flipErrors() const;

private:
    Image withHoles(const PictureRows& picture) const;

    ChannelPair pair_;
    mutable std::optional<ChannelStats> stats_;
    mutable std::optional<StandardMetrics> plain_;
    mutable std::shared_ptr<HdrFlipResult> flip_;
};

// Applies the rule to the measurement. A NaN or infinity against any other value is a difference that some
// figures do not see (a mean, FLIP, SSIM), so it always fails, unless the rule allows a share of failing
// pixels, where it counts as one. The decision's criterion has its pixels.
Decision decide(const Rule& rule, const Measurement& measurement);

}  // namespace diptych
