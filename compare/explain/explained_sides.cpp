// SPDX-License-Identifier: MIT
#include "compare/explain/explained_sides.h"

#include "compare/explain/frame_images.h"
#include "compare/explain/lighting_components.h"
#include "shared/contract/debug_mode.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace diptych {

ExplainedSides::ExplainedSides(const Frame& baseline, const Frame& test, ChannelLighting& lighting)
    : frames_{&baseline, &test}, settings_{baseline.settings, test.settings} {
    for (std::size_t side = 0; side < 2; ++side) {
        const Image& own = own_.at(side) = lighting.lit(settings_.at(side), allChannelsOf(side));
        const Image& all = lit(side);
        Image& residual = residual_.at(side) = Image(all.width, all.height, 3);
        double sum = 0, off = 0;
        for (std::size_t i = 0; i < all.data.size(); ++i) {
            const double value = all.data[i], left = value - own.data[i];
            if (!std::isfinite(left)) continue;
            residual.data[i] = static_cast<float>(left);
            sum += std::abs(value);
            off += std::abs(left);
        }
        reproduction_.at(side) = sum > 0 ? off / sum : off > 0 ? 1 : 0;
    }
}

const Image& ExplainedSides::lit(std::size_t side) const {
    return side == 1 && exposure_ != 1 ? unexposed_ : channelOf(frame(side), Channel::lit);
}

bool ExplainedSides::residualsDiffer() const {
    return !sameBits(residual_[0], residual_[1]);
}

std::string ExplainedSides::residualName() const {
    for (const Frame* const frame : frames_)
        if (frame->settings.msaa > 1) return "samples of a pixel";
    for (const Frame* const frame : frames_)
        if (frame->settings.assign == Assignment::per_object) return "lights per object";
    return {};
}

bool ExplainedSides::haveTerms() const {
    return std::ranges::all_of(termChannels(), [&](Channel channel) {
        const Image *const a = findChannel(frame(0), channel), *const b = findChannel(frame(1), channel);
        return a && b && a->width == b->width && a->height == b->height && a->components == 3 &&
               b->components == 3;
    });
}

void ExplainedSides::findExposure() {
    if (!residualsDiffer()) return;
    const bool terms = haveTerms();
    const auto factor = [&](std::size_t side) {
        return commonFactor(lit(side), terms ? sumOfTerms(frame(side)) : own_.at(side));
    };
    const std::array<std::optional<double>, 2> factors{factor(0), factor(1)};
    std::optional<double> found = exposureBetween(factors[0], factors[1]);
    if (!found && !(factors[0] && factors[1])) found = exposureBetween(1.0, commonFactor(lit(1), lit(0)));
    if (!found) return;
    unexposed_ = lit(1);
    exposure_ = static_cast<float>(*found);
    for (float& value : unexposed_.data) value /= exposure_;
    residual_[1] = differenceOf(lit(1), own_[1]);
}

void ExplainedSides::believe(const Settings& settings, ChannelLighting& lighting) {
    settings_[1] = settings;
    own_[1] = lighting.lit(settings, allChannelsOf(1));
    residual_[1] = differenceOf(lit(1), own_[1]);
}

}  // namespace diptych
