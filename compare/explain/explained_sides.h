// SPDX-License-Identifier: MIT
// The two sides of an explanation, baseline (0) and test (1): their Settings, exposure, and residual after
// relighting their own channels.
#pragma once

#include "compare/explain/channel_lighting.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"

#include <array>
#include <cstddef>
#include <string>

namespace diptych {

// The Frames must outlive it.
class ExplainedSides {
public:
    // Relights each side's channels under its own Settings.
    ExplainedSides(const Frame& baseline, const Frame& test, ChannelLighting& lighting);

    const Frame& frame(std::size_t side) const { return *frames_.at(side); }
    // A side's Settings; the test's include those of believe().
    const Settings& settings(std::size_t side) const { return settings_.at(side); }
    // lit, W x H x 3; the test's is divided by exposure().
    const Image& lit(std::size_t side) const;
    // lit minus our lighting of the side's channels, W x H x 3; 0 where not finite.
    const Image& residual(std::size_t side) const { return residual_.at(side); }
    bool residualsDiffer() const;
    // Name of the residual if its source is known; empty: unexplained.
    std::string residualName() const;
    // Relative size of a side's residual, as Explanation::reproduction.
    double reproduction(std::size_t side) const { return reproduction_.at(side); }
    // Whether both Frames have the terms of lit.
    bool haveTerms() const;

    // A factor on all of the test's lit; 1: none.
    float exposure() const { return exposure_; }
    // Estimates exposure(): relative to the sum of the terms, else to our lighting of the channels, else
    // to the baseline's lit.
    void findExposure();
    // Relights the test under these Settings instead of its declared ones.
    void believe(const Settings& settings, ChannelLighting& lighting);

private:
    const std::array<const Frame*, 2> frames_;
    std::array<Settings, 2> settings_;
    std::array<Image, 2> own_, residual_;  // our lighting of each side's channels, and the residual
    std::array<double, 2> reproduction_{};
    float exposure_ = 1;
    Image unexposed_;  // the test's lit without exposure; empty if there is none
};

}  // namespace diptych
