// SPDX-License-Identifier: MIT
#include "shared/light/fit/lobe.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::ltc {
namespace {

using std::numbers::pi;

glm::dvec2 onDisc(const glm::dvec2& u) {
    const double r = std::sqrt(u.x), phi = 2 * pi * u.y;
    return {r * std::cos(phi), r * std::sin(phi)};
}

// Calls f at the centres of n x n equal cells of the unit square.
template <class F>
void overSquare(int n, const F& f) {
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) f(glm::dvec2((i + 0.5) / n, (j + 0.5) / n));
}

}  // namespace

Lobe::Lobe(double alpha, double n_dot_v, double f0)
    : alpha_(alpha),
      f0_(f0),
      lambda_v_(std::sqrt(n_dot_v * n_dot_v * (1 - alpha * alpha) + alpha * alpha)),
      view_(-std::sqrt(std::max(0.0, 1 - n_dot_v * n_dot_v)), 0, n_dot_v) {}

Lobe::Value Lobe::operator()(const glm::dvec3& l) const {
    if (!(l.z > 0)) return {};
    const glm::dvec3 h = glm::normalize(l + view_);
    const double a2 = alpha_ * alpha_;
    const double across = h.x * h.x + h.y * h.y;  // |n x h|^2, computed without cancellation near the
                                                  // highlight
    const double k = alpha_ / (across + h.z * h.z * a2), d = k * k / pi;
    const double lambda_l = std::sqrt(l.z * l.z * (1 - a2) + a2);
    const double visibility = 0.5 / (l.z * lambda_v_ + view_.z * lambda_l);
    // D G1 (v.h) / (n.v), and dh = dl / (4 v.h); G1 = 2 n.v / (n.v + lambda_v).
    const double schlick = std::pow(std::clamp(1 - glm::dot(view_, h), 0.0, 1.0), 5);
    return {.lobe = d * visibility * l.z * (f0_ + (1 - f0_) * schlick),
            .density = d / (2 * (view_.z + lambda_v_)),
            .schlick = schlick};
}

glm::dvec3 Lobe::sample(const glm::dvec2& u) const {
    const glm::dvec3 v = glm::normalize(glm::dvec3(alpha_ * view_.x, 0, view_.z));
    // x and y of a frame around v: y is across; x lies in the viewer's plane.
    const glm::dvec3 t1(0, -1, 0), t2 = glm::cross(v, t1);
    glm::dvec2 p = onDisc(u);
    const double s = 0.5 * (1 + v.z);
    p.y = (1 - s) * std::sqrt(std::max(0.0, 1 - p.x * p.x)) + s * p.y;
    const glm::dvec3 n = p.x * t1 + p.y * t2 + std::sqrt(std::max(0.0, 1 - glm::dot(p, p))) * v;
    const glm::dvec3 h = glm::normalize(glm::dvec3(alpha_ * n.x, alpha_ * n.y, std::max(n.z, 0.0)));
    return 2 * glm::dot(view_, h) * h - view_;
}

double Transform::upright(const glm::dvec3& l) const {
    if (!(l.z > 0)) return 0;
    const glm::dvec3 p = toCosine(l);
    const double square = glm::dot(p, p);
    return p.z / (pi * a * c * square * square);
}

double Transform::density(const glm::dvec3& l) const {
    if (!(l.z > 0)) return 0;
    const glm::dvec3 p = toCosine(l);
    const double square = glm::dot(p, p);
    return (p.z + tilt * p.x) / (pi * a * c * square * square);
}

glm::dvec3 Transform::sample(const glm::dvec2& u) const {
    const glm::dvec2 p = onDisc(u);
    const double z = std::sqrt(std::max(0.0, 1 - u.x));
    return glm::normalize(fromCosine({p.x, p.y, z}));
}

Transform transformOf(const LtcLobe& lobe, double alpha, double n_dot_v) {
    const double sin2 = std::max(0.0, 1 - n_dot_v * n_dot_v), m2 = n_dot_v * n_dot_v + alpha * alpha * sin2;
    return {.a = double{lobe.in_plane} * 2 * alpha / m2,
            .b = (1 - double{lobe.unsheared}) * std::sqrt(sin2 / m2),
            .c = double{lobe.across} * 2 * alpha,
            .tilt = double{lobe.tilt}};
}

Albedo albedoOf(const Lobe& lobe, int n) {
    Albedo sum;
    overSquare(n, [&](const glm::dvec2& u) {
        const Lobe::Value value = lobe(lobe.sample(u));
        if (!(value.density > 0)) return;
        const double weight = value.lobe / (value.density * n * n);
        sum.magnitude += weight;
        sum.fresnel += weight * value.schlick;
    });
    return sum;
}

double distance(const Lobe& lobe, double all, const Transform& transform, int n) {
    double sum = 0;
    const auto add = [&](const glm::dvec3& l) {
        const Lobe::Value value = lobe(l);
        const double density = value.density + transform.upright(l);
        if (density > 0) sum += std::abs(value.lobe / all - transform.density(l)) / density;
    };
    overSquare(n, [&](const glm::dvec2& u) {
        add(lobe.sample(u));
        add(transform.sample(u));
    });
    return sum / (static_cast<double>(n) * n);
}

}  // namespace diptych::ltc
