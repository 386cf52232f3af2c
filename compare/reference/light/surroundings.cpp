// SPDX-License-Identifier: MIT
#include "compare/reference/light/surroundings.h"

#include "compare/reference/scattering/lobe_sampler.h"
#include "compare/reference/scattering/sampling.h"
#include "shared/scene/model/axes.h"
#include "shared/scene/model/luminance.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace diptych::reference {

// Directions by the cosine with the normal on each side that light passes, by the lobe and by the
// environment's brightness, an equal number of each, combined by the balance heuristic (Veach and Guibas
// 1995, "Optimally Combining Sampling Techniques for Monte Carlo Rendering").
Surroundings surroundingsOf(const Brdf& brdf, const EnvironmentLight* environment, bool lobeOnly,
                            const glm::dvec3& ambient, const Visibility& visible, std::uint64_t seed) {
    constexpr std::uint64_t each = 32;
    const glm::dvec3 n = brdf.normal(), x = perpendicularTo(n), y = glm::cross(n, x);
    const LobeSampler lobe(brdf);
    std::optional<EnvironmentLight::Sampler> bright;
    if (environment) {
        bright.emplace(*environment, [&](const glm::dvec3& middle, double reach) {
            const double n_dot_l = glm::dot(n, middle);
            return std::max((brdf.transmits() ? std::abs(n_dot_l) : n_dot_l) + reach, 0.0);
        });
        if (!(bright->all() > 0)) bright.reset();
    }
    Surroundings sum;
    const auto take = [&](const glm::dvec3& l) {
        Reflected f = brdf(l);
        if (!(f.size() > 0)) return;
        const double density =
            std::abs(glm::dot(n, l)) / std::numbers::pi + lobe.density(l) + (bright ? bright->density(l) : 0);
        glm::dvec3 sent = f.sum() * ambient;
        if (lobeOnly) f.diffuse = glm::dvec3(0);
        if (environment) sent += f.sum() * environment->radiance(l);
        const double light = luminance(sent) / (density * double{each});
        sum.all += light;
        if (!visible(l, std::numeric_limits<double>::infinity())) sum.hidden += light;
    };
    Random random(seed);
    const auto nextShift = [&] {
        const double u = random();
        return glm::dvec2(u, random());
    };
    const glm::dvec2 cosines = nextShift(), lobes = nextShift(), lights = nextShift();
    for (std::uint64_t i = 0; i < each; ++i) {
        const glm::dvec2 u = evenly(i, cosines);
        const double across = std::sqrt(u.x), phi = 2 * std::numbers::pi * u.y;
        const glm::dvec3 along = x * (across * std::cos(phi)) + y * (across * std::sin(phi)),
                         up = n * std::sqrt(1 - u.x);
        take(along + up);
        if (brdf.transmits()) take(along - up);
        take(lobe(evenly(i, lobes)));
        if (bright) take((*bright)(evenly(i, lights)));
    }
    return sum;
}

}  // namespace diptych::reference
