// SPDX-License-Identifier: MIT
// The two sides of an explanation, the baseline (0) and the test (1): as much of what they say as is
// believed, and the rest, what our lighting of a side's own channels leaves of its lit.
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
    // Lights each side's own channels under its own Settings.
    ExplainedSides(const Frame& baseline, const Frame& test, ChannelLighting& lighting);

    const Frame& frame(std::size_t side) const { return *frames_.at(side); }
    // A side's Settings; the test's with those that believe() was told.
    const Settings& settings(std::size_t side) const { return settings_.at(side); }
    // lit, W x H x 3; the test's without exposure().
    const Image& lit(std::size_t side) const;
    // What lit has beyond our lighting of its own channels, W x H x 3; 0 where that is not finite.
    const Image& rest(std::size_t side) const { return rest_.at(side); }
    bool restsDiffer() const;
    // What the rest is where it is known what makes it; empty: it is what no cause explains.
    std::string restName() const;
    // How large a side's rest is, as Explanation::reproduction.
    double reproduction(std::size_t side) const { return reproduction_.at(side); }
    // Whether both say the terms of their lit.
    bool haveTerms() const;

    // A factor on all of the test's lit; 1: none.
    float exposure() const { return exposure_; }
    // Looks for one: beyond the sum of its terms, or else beyond our lighting of its channels, or else beyond
    // the baseline's lit.
    void findExposure();
    // That the test has these Settings, whatever it says: lights it anew.
    void believe(const Settings& settings, ChannelLighting& lighting);

private:
    const std::array<const Frame*, 2> frames_;
    std::array<Settings, 2> settings_;
    std::array<Image, 2> own_, rest_;  // our lighting of a side's own channels, and what it leaves
    std::array<double, 2> reproduction_{};
    float exposure_ = 1;
    Image unexposed_;  // the test's lit without exposure; empty where there is none
};

}  // namespace diptych
