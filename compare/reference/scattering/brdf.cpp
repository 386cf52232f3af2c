// SPDX-License-Identifier: MIT
#include "compare/reference/scattering/brdf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::reference {
namespace {

// GGX, 1/sr; 0 for microfacets that face down. Walter et al. 2007, "Microfacet Models for Refraction
// through Rough Surfaces", equation 33; anisotropic: Burley 2012, "Physically-Based Shading at Disney",
// equation 13.
double distribution(const Widths& w, const glm::dvec3& half, double n_dot_h) {
    if (!(n_dot_h > 0)) return 0;
    if (w.isotropic())
        return squared(w.across) /
               (std::numbers::pi * squared(squared(n_dot_h) * (squared(w.across) - 1) + 1));
    const double k =
        squared(glm::dot(w.x, half) / w.along) + squared(glm::dot(w.y, half) / w.across) + squared(n_dot_h);
    return 1 / (std::numbers::pi * w.along * w.across * squared(k));
}

// Heitz 2014, "Understanding the Masking-Shadowing Function", equation 72.
double lambda(double alpha, double cosine) {
    const double tangent2 = (1 - squared(cosine)) / squared(cosine);
    return (std::sqrt(1 + squared(alpha) * tangent2) - 1) / 2;
}

// Schlick 1994, "An Inexpensive BRDF Model".
double schlick(double v_dot_h) {
    const double x = std::clamp(1 - v_dot_h, 0.0, 1.0);
    return squared(squared(x)) * x;
}
// Schlick's curve, mixed with the film's by its weight.
glm::dvec3 fresnel(const ThinFilm& film, const glm::dvec3& f0, double f90, double cosine) {
    const glm::dvec3 plain = f0 + (glm::dvec3(f90) - f0) * schlick(cosine);
    return film.weight > 0 ? glm::mix(plain, film.reflected(cosine, f0), film.weight) : plain;
}

double viewCosine(const Surface& s) {
    return std::clamp(glm::dot(s.normal, s.to_viewer), min_n_dot_v, 1.0);
}

}  // namespace

double widthTowards(const Widths& w, const glm::dvec3& direction) {
    if (w.isotropic()) return w.across;
    const double x = glm::dot(w.x, direction), y = glm::dot(w.y, direction);
    const double square_length = squared(x) + squared(y);
    if (!(square_length > 0)) return w.across;
    return std::sqrt((squared(w.along * x) + squared(w.across * y)) / square_length);
}

// The extension's text: alpha_t = mix(alpha, 1, strength^2), alpha_b = alpha.
Widths widthsOf(const Surface& s) {
    const double alpha = squared(std::max(s.roughness, min_roughness));
    if (!(s.anisotropy > 0)) return {alpha, alpha};
    return {alpha + (1 - alpha) * squared(s.anisotropy), alpha, s.anisotropy_direction,
            glm::cross(s.normal, s.anisotropy_direction)};
}

Surface isotropic(const Surface& surface) {
    return isotropic(surface, widthsOf(surface).mean());
}

Surface isotropic(const Surface& surface, double width) {
    if (!(surface.anisotropy > 0)) return surface;
    Surface s = surface;
    s.roughness = std::sqrt(width);
    s.anisotropy = 0;
    s.anisotropy_direction = glm::dvec3(0);
    return s;
}

Surface coatOf(const Surface& s) {
    Surface coat;
    coat.position = s.position;
    coat.to_viewer = s.to_viewer;
    coat.normal = s.clearcoat_normal;
    coat.geometric_normal = s.geometric_normal;
    coat.albedo = glm::dvec3(1);
    coat.metallic = 1;
    coat.roughness = s.clearcoat_roughness;
    coat.occlusion = s.occlusion;
    return coat;
}

// KHR_materials_clearcoat: Schlick's Fresnel of an index of 1.5 at the coat's normal.
double coatWeight(const Surface& s) {
    if (!(s.clearcoat > 0)) return 0;
    return s.clearcoat * (0.04 + 0.96 * schlick(std::abs(glm::dot(s.clearcoat_normal, s.to_viewer))));
}

glm::dvec3 emitted(const Surface& s) {
    return s.emission * (1 - coatWeight(s));
}

Surface behind(const Surface& surface) {
    Surface s = surface;
    s.normal = -surface.normal;
    s.geometric_normal = -surface.geometric_normal;
    s.to_viewer = surface.to_viewer - surface.normal * (2 * glm::dot(surface.normal, surface.to_viewer));
    s.albedo = surface.diffuse_transmission_color;
    s.diffuse_transmission = 1 - surface.diffuse_transmission;
    return s;
}

Brdf::Brdf(const Surface& s, const Compensation& compensation)
    : compensation_(compensation),
      normal_(s.normal),
      to_viewer_(s.to_viewer),
      albedo_(s.albedo),
      dielectric_f0_(s.dielectric_f0),
      base_layer_(s.base_layer),
      metallic_(s.metallic),
      dielectric_f90_(s.dielectric_f90),
      scattered_(s.albedo * ((1 - s.metallic) * (1 - s.transmission) * (1 - s.diffuse_transmission))),
      from_behind_(s.diffuse_transmission_color *
                   ((1 - s.metallic) * (1 - s.transmission) * s.diffuse_transmission)),
      film_(filmOf(s)),
      sheen_color_(s.sheen_color),
      widths_(widthsOf(s)),
      n_dot_v_(viewCosine(s)),
      lambda_v_(lambda(widthTowards(widths_, s.to_viewer), n_dot_v_)) {
    if (hasSheen(s)) sheen_.emplace(s.sheen_roughness, n_dot_v_);
}

Reflected Brdf::operator()(const glm::dvec3& to_light) const {
    Reflected f = evaluate(to_light);
    const double n_dot_l = std::clamp(glm::dot(normal_, to_light), 0.0, 1.0);
    f.specular += compensation_.between * (n_dot_l / std::numbers::pi);
    return f;
}

Reflected Brdf::evaluate(const glm::dvec3& to_light) const {
    const double n_dot_l = std::min(glm::dot(normal_, to_light), 1.0);
    if (n_dot_l < 0 && transmits()) return {glm::dvec3(0), glm::dvec3(0), transmit(to_light, n_dot_l)};
    if (!(n_dot_l > 0)) return {};
    const glm::dvec3 half = halfway(to_light);
    const double n_dot_h = std::min(glm::dot(normal_, half), 1.0);
    if (sheen_) return {glm::dvec3(0), sheen_color_ * (*sheen_)(n_dot_l, n_dot_h)};
    const double v_dot_h = compensation_.film_cosine.value_or(glm::dot(to_viewer_, half));

    // Height-correlated masking and shadowing; Heitz 2014, equation 99.
    const double masking = 1 / (1 + lambda_v_ + lambda(widthTowards(widths_, to_light), n_dot_l));
    const double lobe = distribution(widths_, half, n_dot_h) * masking / (4 * n_dot_l * n_dot_v_);
    glm::dvec3 layer(0), metal(0);
    if (metallic_ < 1) layer = fresnel(film_, dielectric_f0_, dielectric_f90_, v_dot_h);
    if (metallic_ > 0) metal = fresnel(film_, albedo_, 1, v_dot_h);
    const glm::dvec3 mixed =
        layer * compensation_.dielectric * (1 - metallic_) + metal * compensation_.metal * metallic_;
    return {scattered_ * baseUnder(layer) * (n_dot_l / std::numbers::pi), mixed * (lobe * n_dot_l)};
}

// GGX is proportional to 1 / k^2; k is the squared length of the half vector after its components along the
// surface are divided by the widths. Turning the light turns the half vector by that over |l + v|.
glm::dvec2 Brdf::rounding(const glm::dvec3& to_light, double angle_error) const {
    const double of_cosine = angle_error / std::abs(glm::dot(normal_, to_light));
    const glm::dvec3 half = halfway(to_light), up = normal_ * glm::dot(normal_, half), beside = half - up;
    if (sheen_) return glm::dvec2(of_cosine);
    const glm::dvec3 divided =
        up + (widths_.isotropic() ? beside / squared(widths_.across)
                                  : widths_.x * (glm::dot(widths_.x, half) / squared(widths_.along)) +
                                        widths_.y * (glm::dot(widths_.y, half) / squared(widths_.across)));
    const double k = glm::dot(divided, half), steepness = 4 * glm::length(divided - half * k) / k;
    return {of_cosine,
            of_cosine + steepness * 2 * angle_error / std::max(glm::length(to_light + to_viewer_), 1e-3)};
}

glm::dvec3 Brdf::halfway(const glm::dvec3& to_light) const {
    const glm::dvec3 sum = to_light + to_viewer_;
    const double length = glm::length(sum);
    return length > 1e-12 ? sum / length : normal_;
}

// A dielectric's Lambertian base receives the light that its specular layer does not reflect.
glm::dvec3 Brdf::baseUnder(const glm::dvec3& layer) const {
    return compensation_.base.value_or(1.0 - lostToLayer(base_layer_, layer));
}

// The extension's diffuse_btdf, under the layer. `n_dot_l`: below 0.
glm::dvec3 Brdf::transmit(const glm::dvec3& to_light, double n_dot_l) const {
    const glm::dvec3 half = halfway(to_light - normal_ * (2 * n_dot_l));
    const double v_dot_h = compensation_.film_cosine.value_or(glm::dot(to_viewer_, half));
    const glm::dvec3 layer = fresnel(film_, dielectric_f0_, dielectric_f90_, v_dot_h);
    return from_behind_ * baseUnder(layer) * (-n_dot_l / std::numbers::pi);
}

glm::dvec3 transmitted(const Surface& s) {
    const glm::dvec3 layer = fresnel(filmOf(s), s.dielectric_f0, s.dielectric_f90, viewCosine(s));
    const glm::dvec3 base =
        s.albedo * (1.0 - lostToLayer(s.base_layer, layer)) * (s.transmission * (1 - s.metallic));
    return base * ((1 - coatWeight(s)) * sheenAlbedoScaling(s));
}

}  // namespace diptych::reference
