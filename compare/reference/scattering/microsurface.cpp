// SPDX-License-Identifier: MIT
#include "compare/reference/scattering/microsurface.h"

#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::reference {
namespace {

// Rays along the surface hit a facet at once, like rays just beside them.
constexpr double minCosine = 1e-9;
constexpr double minView = 1e-4;  // n.v, as in the material (README.md, "The model")

}  // namespace

// Smith's Lambda for GGX; for directions from below, Lambda(-w) = -1 - Lambda(w).
double Microsurface::lambda(const glm::dvec3& w) const {
    const double z = std::clamp(std::abs(w.z), minCosine, 1.0);
    const double above = (std::sqrt(1 + squared(alpha_) * (1 - squared(z)) / squared(z)) - 1) / 2;
    return w.z < 0 ? -1 - above : above;
}

// Samples a facet visible from a direction above or below: Dupuy and Benyoub 2023, "Sampling Visible GGX
// Normals with Spherical Caps".
glm::dvec3 Microsurface::visibleNormal(const glm::dvec3& direction, Random& random) const {
    const glm::dvec3 w = glm::normalize(glm::dvec3(alpha_ * direction.x, alpha_ * direction.y, direction.z));
    const double phi = 2 * std::numbers::pi * random(), z = (1 - random()) * (1 + w.z) - w.z;
    const double r = std::sqrt(std::clamp(1 - z * z, 0.0, 1.0));
    const glm::dvec3 h(r * std::cos(phi) + w.x, r * std::sin(phi) + w.y, z + w.z);
    return glm::normalize(glm::dvec3(alpha_ * h.x, alpha_ * h.y, std::max(h.z, 1e-100)));
}

// A ray passes another height with probability (C / C')^Lambda, where C is the fraction of the surface
// below. The logarithm of C suffices for any height distribution; 0 is the top.
double Microsurface::next(const glm::dvec3& on, double height, Random& random) const {
    const double passes = lambda(on), fraction = std::log1p(-random());
    if (on.z > 0 && fraction <= passes * height) return 1;
    return std::min(height - fraction / passes, 0.0);
}

// The phase function of facets visible from `back_`: D (Walter et al. 2007) over their projected area,
// times the probability that the light leaves the surface.
Microsurface::Facet::Reflection Microsurface::Facet::evaluate(const glm::dvec3& to_light) const {
    const glm::dvec3 h = to_light + back_;
    const double length = glm::length(h);
    if (!(to_light.z > 0) || !(length > 1e-12) || !(h.z > 0)) return {0, 0};
    const double cosine = h.z / length, alpha2 = squared(surface_.alpha_);
    const double d = alpha2 / (std::numbers::pi * squared(squared(cosine) * (alpha2 - 1) + 1));
    const double seen = std::abs(1 + surface_.lambda(back_)) * std::max(std::abs(back_.z), minCosine);
    return {glm::dot(back_, h) / length, d / (4 * seen) * std::exp(surface_.lambda(to_light) * height_)};
}

Between::Between(const Surface& surface)
    : surface_(isotropic(withoutFilm(surface))),
      facets_(widthsOf(surface_).across),
      x_(perpendicularTo(surface.normal)),
      y_(glm::cross(surface.normal, x_)) {
    from_ = {glm::dot(x_, surface.to_viewer), glm::dot(y_, surface.to_viewer),
             std::max(glm::dot(surface.normal, surface.to_viewer), minView)};
    from_ = glm::normalize(from_);
    Surface white = surface_;
    white.albedo = glm::dvec3(1);
    white.metallic = 1;
    fraction_ = std::max(1 - specularAlbedo(white).g, 0.0);
}

Between::Path Between::path(Random& random, const std::function<void(const Add&)>& lights) const {
    const Surface& s = surface_;
    const auto local = [&](const glm::dvec3& w) {
        return glm::dvec3(glm::dot(x_, w), glm::dot(y_, w), glm::dot(s.normal, w));
    };
    const auto fresnel = [](const glm::dvec3& f0, double f90, double cosine) {
        return f0 + (glm::dvec3(f90) - f0) * std::pow(std::clamp(1 - cosine, 0.0, 1.0), 5);
    };
    struct Weights {
        glm::dvec3 layer, metal;
    };
    const auto reflected = [&](const Weights& w, double cosine) -> Weights {
        return {w.layer * fresnel(s.dielectric_f0, s.dielectric_f90, cosine),
                w.metal * fresnel(s.albedo, 1, cosine)};
    };
    const auto mixed = [&](const Weights& w) { return w.layer * (1 - s.metallic) + w.metal * s.metallic; };
    Path result;
    Weights weights;
    glm::dvec3 out;
    int met = 0;
    const auto visit = [&](const Microsurface::Facet& facet, double cosine) {
        if (++met > 1)
            lights([&](const glm::dvec3& to_light, const glm::dvec3& irradiance) {
                const Microsurface::Facet::Reflection reflection = facet.evaluate(local(to_light));
                if (reflection.fraction > 0)
                    result.direct +=
                        mixed(reflected(weights, reflection.cosine)) * (reflection.fraction * irradiance);
            });
        weights = reflected(weights, cosine);
    };
    do {
        met = 0;
        weights = {glm::dvec3(1), glm::dvec3(1)};
        out = facets_.trace(from_, random, visit);
    } while (met < 2);
    result.layer = weights.layer;
    result.weight = mixed(weights);
    result.direction = x_ * out.x + y_ * out.y + s.normal * out.z;
    return result;
}

}  // namespace diptych::reference
