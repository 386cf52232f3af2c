// SPDX-License-Identifier: MIT
#include "compare/reference/scattering/multiscatter.h"

#include "compare/reference/scattering/ambient.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace diptych::reference {
namespace {

// One material's lobe with its multiple-scattering terms.
struct Lobe {
    glm::dvec3 factor{1}, between{0};
};

// `single`: the lobe's directional albedo; `white`: the same with F = 1; `f0`: at normal incidence;
// `mean`: the mean of F over the cosine-weighted hemisphere.
Lobe compensated(Multiscatter multiscatter, const glm::dvec3& single, double white, const glm::dvec3& f0,
                 const glm::dvec3& mean) {
    if (multiscatter == Multiscatter::energy) return {1.0 + f0 * ((1 - white) / white), glm::dvec3(0)};
    // Light that meets k + 2 facets is reflected k + 1 times by the mean reflectance, stays in the surface
    // k + 1 times, and leaves with `single`. This sums the geometric series.
    glm::dvec3 sum(0);
    for (int c = 0; c < 3; ++c) {
        const double again = mean[c] * (1 - white);
        sum[c] = single[c] * again / (1 - again);
    }
    return {glm::dvec3(1), sum};
}

// The mean of Schlick's Fresnel over the cosine-weighted hemisphere, 2 F(mu) mu dmu, by Simpson's rule.
glm::dvec3 meanFresnel(const glm::dvec3& f0, double f90) {
    constexpr int steps = 200;
    double weight = 0;
    for (int i = 0; i <= steps; ++i) {
        const double mu = static_cast<double>(i) / steps;
        const double simpson = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
        weight += simpson * 2 * mu * std::pow(1 - mu, 5) / (3.0 * steps);
    }
    return f0 + (glm::dvec3(f90) - f0) * weight;
}

// A film may reflect more than the layer without it, and the base then gets no more than that leaves at n.v.
glm::dvec3 filmTowardsViewer(const Surface& s) {
    if (!(s.iridescence > 0)) return glm::dvec3(0);
    const double cosine = std::clamp(glm::dot(s.normal, s.to_viewer), min_n_dot_v, 1.0);
    const glm::dvec3 plain = s.dielectric_f0 + (s.dielectric_f90 - s.dielectric_f0) * std::pow(1 - cosine, 5);
    return glm::mix(plain, filmOf(s).reflected(cosine, s.dielectric_f0), s.iridescence);
}

}  // namespace

Compensation compensationOf(const Surface& original, Multiscatter multiscatter) {
    if (multiscatter == Multiscatter::off) return {};
    if (multiscatter == Multiscatter::walk) return {.base = glm::dvec3(1)};
    const Surface surface = isotropic(withoutFilm(original));
    Surface white = surface, metal = surface, dielectric = surface;
    white.albedo = glm::dvec3(1);
    white.metallic = metal.metallic = 1;
    dielectric.metallic = 0;
    const double all = specularAlbedo(white).g;
    Lobe of_metal, of_layer;
    Compensation result;
    if (surface.metallic > 0) {
        of_metal = compensated(multiscatter, specularAlbedo(metal), all, surface.albedo,
                               meanFresnel(surface.albedo, 1));
        result.metal = of_metal.factor;
    }
    if (surface.metallic < 1) {
        const glm::dvec3 single = specularAlbedo(dielectric);
        of_layer = compensated(multiscatter, single, all, surface.dielectric_f0,
                               meanFresnel(surface.dielectric_f0, surface.dielectric_f90));
        result.dielectric = of_layer.factor;
        const glm::dvec3 layer = single * of_layer.factor + of_layer.between;
        if (surface.base_layer == BaseLayer::max)
            result.base = 1.0 - lostToLayer(surface.base_layer, glm::max(layer, filmTowardsViewer(original)));
    }
    result.between = of_layer.between * (1 - surface.metallic) + of_metal.between * surface.metallic;
    return result;
}

}  // namespace diptych::reference
