// SPDX-License-Identifier: MIT
#include "compare/reference/scattering/transmission.h"

#include "compare/reference/scattering/ambient.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::reference {
namespace {

double squareOf(double x) {
    return x * x;
}

// The factor of GGX's width is the KHR sample viewer's applyIorToRoughness, also of thin walls: microfacets
// of index 1 do not refract.
double widthOf(const Surface& s) {
    const double alpha = squareOf(s.roughness);
    if (s.ior == 0) return alpha;
    return alpha * std::clamp(2 * s.ior - 2, 0.0, 1.0);
}

}  // namespace

// KHR_materials_dispersion: half the spread is (ior - 1) 0.025 dispersion; red is refracted least.
double indexOf(const Surface& s, int component) {
    if (s.ior == 0) return std::numeric_limits<double>::infinity();
    const double half = (s.ior - 1) * 0.025 * s.dispersion;
    return std::max(s.ior + half * (component - 1), 1.0);
}

glm::dvec3 refractedInto(const glm::dvec3& along, const glm::dvec3& normal, double index) {
    const double ratio = 1 / index, cosine = -glm::dot(normal, along);
    const double inside = std::sqrt(1 - squareOf(ratio) * std::max(1 - squareOf(cosine), 0.0));
    return along * ratio + normal * (ratio * cosine - inside);
}

std::optional<glm::dvec3> refractedOut(const glm::dvec3& along, const glm::dvec3& normal, double index) {
    const double cosine = -glm::dot(normal, along);
    const double square_outside = 1 - squareOf(index) * std::max(1 - squareOf(cosine), 0.0);
    if (!(square_outside > 0)) return {};
    return glm::normalize(along * index + normal * (index * cosine - std::sqrt(square_outside)));
}

double reflectedInside(double cosine, double index) {
    const double inside = std::clamp(cosine, 0.0, 1.0),
                 square_outside = 1 - squareOf(index) * (1 - squareOf(inside));
    if (!(square_outside > 0)) return 1;
    const double outside = std::sqrt(square_outside);
    const double across = (index * inside - outside) / (index * inside + outside),
                 along = (inside - index * outside) / (inside + index * outside);
    return (squareOf(across) + squareOf(along)) / 2;
}

glm::dvec3 attenuationOf(const Surface& s, double distance) {
    if (!(distance > 0) || !(s.attenuation_distance > 0)) return glm::dvec3(1);
    glm::dvec3 result;
    for (int c = 0; c < 3; ++c)
        result[c] = std::pow(s.attenuation_color[c], distance / s.attenuation_distance);
    return result;
}

glm::dvec3 slabShift(const Surface& s, int component) {
    if (!(s.thickness > 0)) return glm::dvec3(0);
    return refractedInto(-s.to_viewer, s.normal, indexOf(s, component)) * s.thickness;
}

TransmittedLobe::TransmittedLobe(const Surface& s) : normal_(s.normal), straight_(-s.to_viewer) {
    const double alpha = widthOf(s);
    if (!(alpha > squareOf(min_roughness)) || !(glm::dot(s.normal, s.to_viewer) > min_n_dot_v)) return;
    Surface lobe;
    lobe.normal = s.normal;
    lobe.to_viewer = s.to_viewer;
    lobe.metallic = 1;
    lobe.albedo = glm::dvec3(1);
    lobe.roughness = std::sqrt(alpha);
    brdf_.emplace(lobe);
    sampler_.emplace(*brdf_);
    whole_ = specularAlbedo(lobe).r;
}

TransmittedLobe::Sample TransmittedLobe::operator()(const glm::dvec2& u) const {
    if (isOneRay()) return {straight_, 1};
    const glm::dvec3 l = (*sampler_)(u);
    const double n_dot_l = glm::dot(normal_, l);
    if (!(n_dot_l > 0)) return {straight_, 0};
    return {l - normal_ * (2 * n_dot_l), brdf_->lobe(l).r / (sampler_->density(l) * whole_)};
}

bool isBent(const Surface& s) {
    return (s.thickness > 0 && (s.ior != 1 || s.dispersion > 0)) || !TransmittedLobe(s).isOneRay();
}

}  // namespace diptych::reference
