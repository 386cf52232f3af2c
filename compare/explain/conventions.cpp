// SPDX-License-Identifier: MIT
#include "compare/explain/conventions.h"

#include "compare/explain/frame_images.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace diptych {

namespace {

constexpr std::array knownConventions{
    Convention{"base-layer", "component",
               "a base layer that loses, per component, what its coating reflects"},
    Convention{"spot-cone", "smoothstep", "spot lights with a smoothstep falloff at the cone edge"},
    Convention{"range-window", "squared", "lights with a squared range window"},
    Convention{"multiscatter", "energy", "multiple scattering between microfacets, as a gain of the lobe"},
    Convention{"multiscatter", "fdez", "multiple scattering between microfacets, as a separate lobe"},
};
// The same threshold as for other undeclared Settings (undeclared_settings.cpp).
constexpr double worthHaving = 0.5;

bool hasTwice(const std::vector<Convention>& some) {
    for (std::size_t i = 0; i < some.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (some[i].option == some[k].option) return true;
    return false;
}

}  // namespace

bool isForeign(const Frame& frame) {
    return frame.origin.external || (!frame.origin.file.empty() && frame.origin.commit.empty());
}

Settings withConventions(Settings said, const std::vector<Convention>& conventions) {
    for (const Convention& each : conventions) said.set(each.option, std::string(each.value));
    return said;
}

std::vector<Convention> nearestConventions(const Settings& said, const ConventionTrial& trial) {
    const Image plain = trial.draw(said);
    std::vector<Convention> effective;
    for (const Convention& each : knownConventions)
        if (said.valueOf(each.option) == Settings().valueOf(each.option) &&
            !sameBits(trial.draw(withConventions(said, {each})), plain))
            effective.push_back(each);
    std::vector<Convention> best;
    Image nearest = plain;
    double least = trial.distance(plain);
    for (std::size_t subset = 1; subset < std::size_t{1} << effective.size(); ++subset) {
        std::vector<Convention> some;
        for (std::size_t i = 0; i < effective.size(); ++i)
            if ((subset >> i & 1) != 0) some.push_back(effective[i]);
        if (hasTwice(some)) continue;
        Image picture = trial.draw(withConventions(said, some));
        const double distance = trial.distance(picture);
        if (!(distance < least)) continue;
        least = distance;
        best = std::move(some);
        nearest = std::move(picture);
    }
    // Each must be worth its change beside all others; after a removal, all are tested again.
    for (std::size_t i = 0; i < best.size();) {
        std::vector<Convention> others = best;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        Image without = trial.draw(withConventions(said, others));
        const double gained = trial.distance(without) - least;
        if (gained > worthHaving * meanOf(errorsOf(nearest, without))) {
            ++i;
            continue;
        }
        least += gained;
        nearest = std::move(without);
        best = std::move(others);
        i = 0;
    }
    return best;
}

}  // namespace diptych
