// SPDX-License-Identifier: MIT
// Every figure of two images of one channel, each worked out when it is asked for.
#pragma once

#include "compare/metrics/flip.h"
#include "compare/metrics/plain.h"
#include "compare/verdict/rules.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Two images of one channel, alike in size and components. They outlive their Measurement.
struct ChannelPair {
    Metric metric = Metric::absolute;  // of max, mean, rmse, p99, p999 and the share of failing pixels
    ChannelKind kind = ChannelKind::color;
    bool display = false;  // sRGB values in [0, 1]; else linear
    const Image* reference = nullptr;
    const Image* test = nullptr;
    const Coverage* coverage = nullptr;
    const ChannelStats* stats = nullptr;  // where they are known already
    HdrFlipOptions flip = {};             // its `covered` is set here
};

class Measurement {
public:
    explicit Measurement(const ChannelPair& pair) : pair_(pair) {}

    // Nothing where a figure is not defined: flip and ssim of what is no colour, angles of what is no vector.
    std::optional<double> operator()(const Quantity& quantity) const;
    Measured asMeasured() const;  // of this, which must outlive it

    // All that are defined, in the table's order.
    std::vector<std::pair<std::string, double>> all() const;

    bool isVector() const;  // of 3 components
    // As given; else mean and rmse of an absolute error are over components, as other programs have them.
    const ChannelStats& stats() const;
    const PlainMetrics& plain() const;
    const HdrFlipResult* flip() const;  // nullptr where it is not defined

private:
    Image withHoles(const Image& image) const;
    double failingShare(double above) const;

    ChannelPair pair_;
    mutable std::optional<ChannelStats> stats_;
    mutable std::optional<PlainMetrics> plain_;
    mutable std::optional<HdrFlipResult> flip_;
};

// What the rule decides about what was measured. A NaN or infinity against anything else is a difference that
// some figures are blind to (a mean, FLIP, SSIM): it fails whatever they are, unless the rule grants a share
// of failing pixels, among which it is.
Decision decide(const Rule& rule, const Measurement& measurement);

}  // namespace diptych
