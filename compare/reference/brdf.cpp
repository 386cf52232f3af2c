// SPDX-License-Identifier: MIT
#include "compare/reference/brdf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::reference {
namespace {

// The bounds of the material model (README.md of this folder, "The model"), restated independently. A
// perfect mirror under a punctual light is a delta function that cannot be sampled. A normal map may turn
// a visible surface away from the viewer.
constexpr double least_roughness = 0.045, least_n_dot_v = 1e-4;

double square(double x) {
    return x * x;
}

// GGX, 1/sr; 0 for microfacets that face down. Walter et al. 2007, "Microfacet Models for Refraction
// through Rough Surfaces", equation 33.
double distribution(double alpha, double n_dot_h) {
    if (!(n_dot_h > 0)) return 0;
    return square(alpha) / (std::numbers::pi * square(square(n_dot_h) * (square(alpha) - 1) + 1));
}

// Heitz 2014, "Understanding the Masking-Shadowing Function", equation 72.
double lambda(double alpha, double cosine) {
    const double tangent2 = (1 - square(cosine)) / square(cosine);
    return (std::sqrt(1 + square(alpha) * tangent2) - 1) / 2;
}

// Schlick 1994, "An Inexpensive BRDF Model".
double schlick(double v_dot_h) {
    const double x = std::clamp(1 - v_dot_h, 0.0, 1.0);
    return square(square(x)) * x;
}
glm::dvec3 fresnel(const glm::dvec3& f0, double f90, double weight) {
    return f0 + (glm::dvec3(f90) - f0) * weight;
}

}  // namespace

Brdf::Brdf(const Surface& s, const Compensation& compensation)
    : compensation_(compensation),
      normal_(s.normal),
      to_viewer_(s.to_viewer),
      albedo_(s.albedo),
      dielectric_f0_(s.dielectric_f0),
      base_layer_(s.base_layer),
      metallic_(s.metallic),
      scattered_(1 - s.transmission),
      dielectric_f90_(s.dielectric_f90),
      alpha_(square(std::max(s.roughness, least_roughness))),
      n_dot_v_(std::clamp(glm::dot(s.normal, s.to_viewer), least_n_dot_v, 1.0)),
      lambda_v_(lambda(alpha_, n_dot_v_)) {}

Reflected Brdf::operator()(const glm::dvec3& to_light) const {
    Reflected f = evaluate(to_light);
    const double n_dot_l = std::clamp(glm::dot(normal_, to_light), 0.0, 1.0);
    f.specular += compensation_.between * (n_dot_l / std::numbers::pi);
    return f;
}

Reflected Brdf::evaluate(const glm::dvec3& to_light) const {
    const double n_dot_l = std::min(glm::dot(normal_, to_light), 1.0);
    if (!(n_dot_l > 0)) return {};
    const glm::dvec3 sum = to_light + to_viewer_;
    const double length = glm::length(sum);
    const glm::dvec3 half = length > 1e-12 ? sum / length : normal_;
    const double n_dot_h = std::min(glm::dot(normal_, half), 1.0);
    const double weight = schlick(glm::dot(to_viewer_, half));

    // Height-correlated masking and shadowing; Heitz 2014, equation 99.
    const double masking = 1 / (1 + lambda_v_ + lambda(alpha_, n_dot_l));
    const double lobe = distribution(alpha_, n_dot_h) * masking / (4 * n_dot_l * n_dot_v_);
    const glm::dvec3 layer = fresnel(dielectric_f0_, dielectric_f90_, weight);
    const glm::dvec3 metal = fresnel(albedo_, 1, weight);
    // A dielectric's Lambertian base receives the light that its specular layer does not reflect.
    const glm::dvec3 base = compensation_.base.value_or(1.0 - lostToLayer(base_layer_, layer));
    const glm::dvec3 mixed =
        layer * compensation_.dielectric * (1 - metallic_) + metal * compensation_.metal * metallic_;
    return {albedo_ * base * ((1 - metallic_) * scattered_ * n_dot_l / std::numbers::pi),
            mixed * (lobe * n_dot_l)};
}

glm::dvec3 transmitted(const Surface& s) {
    const double cosine = std::clamp(glm::dot(s.normal, s.to_viewer), least_n_dot_v, 1.0);
    const glm::dvec3 layer = fresnel(s.dielectric_f0, s.dielectric_f90, schlick(cosine));
    return s.albedo * (1.0 - lostToLayer(s.base_layer, layer)) * (s.transmission * (1 - s.metallic));
}

}  // namespace diptych::reference
