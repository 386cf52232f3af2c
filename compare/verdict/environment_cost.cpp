// SPDX-License-Identifier: MIT
#include "compare/verdict/environment_cost.h"

#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace diptych {
namespace {

bool isDiffuse(const DebugMode& mode) {
    return mode.channel == Channel::lit_diffuse || mode.channel == Channel::lit_transmission;
}
// The costs are sums over the lobes of the base, the sheen and the clear coat, so they bound the parts too.
bool isSpecular(const DebugMode& mode) {
    return mode.channel == Channel::lit_specular ||
           (isLit(mode.channel) && layerOf(mode.channel) != 0 && !isDiffuse(mode));
}
bool isAll(const DebugMode& mode) {
    return mode.channel == Channel::lit || mode.channel == Channel::lit_environment;
}

// Widening of the lobe by sampling, as a fraction of its solid angle, because each sample represents a
// part of it; and the error due to the number of samples per pixel.
double spreadOf(const Settings& settings) {
    return 4 * std::numbers::pi * std::exp2(2 * double{settings.ibl_bias}) / settings.ibl_samples;
}
double sampledPart(const Settings& settings) {
    return sampledFraction / std::sqrt(static_cast<double>(settings.ibl_samples));
}

}  // namespace

EnvironmentCost::EnvironmentCost(const FramePair& pair) {
    if (!pair.hasReference() || pair.reference().environment_costs.empty()) return;
    costs_ = &pair.reference().environment_costs;
    settings_ = &pair.path().settings;
}

double EnvironmentCost::allowedDiffuse(const DebugMode& mode, std::size_t pixel) const {
    if (!costs_ || (!isDiffuse(mode) && !isAll(mode))) return 0;
    return double{costs_->pixel(pixel)[static_cast<std::size_t>(settings_->ibl_diffuse)]};
}

double EnvironmentCost::allowedSpecular(const DebugMode& mode, std::size_t pixel) const {
    if (!costs_ || (!isSpecular(mode) && !isAll(mode))) return 0;
    const float* const costs = costs_->pixel(pixel);
    const auto kind = static_cast<std::size_t>(settings_->ibl_diffuse);
    const bool split = settings_->ibl == Ibl::split;
    const double wider{costs[7]}, lobe{costs[8]};
    return double{costs[split ? 3 + kind : 6]} + spreadOf(*settings_) * wider +
           (split ? filteredFraction : sampledPart(*settings_)) * lobe;
}

std::string EnvironmentCost::because(const DebugMode& mode) const {
    const bool split = settings_->ibl == Ibl::split, map = settings_->ibl_diffuse == IblDiffuse::map;
    const std::string diffuse = fmt::format("irradiance by {} and the base's mean share of it",
                                            map ? "a map" : "harmonics of order 2"),
                      specular =
                          split ? fmt::format("the split sum, the spread of its maps' samples and {:.3g} %",
                                              100 * filteredFraction)
                                : fmt::format("{} samples of the lobe, their spread and {:.3g} %,",
                                              settings_->ibl_samples, 100 * sampledPart(*settings_));
    if (!isDiffuse(mode) && !isSpecular(mode) && !isAll(mode)) return {};
    return fmt::format("; plus the error of {} at each pixel, as the reference integrates it",
                       isDiffuse(mode)    ? diffuse
                       : isSpecular(mode) ? specular
                                          : diffuse + ", " + specular);
}

}  // namespace diptych
