// SPDX-License-Identifier: MIT
#include "compare/reference/scattering/sheen.h"

#include "compare/reference/scattering/gauss_legendre.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::reference {
Surface sheenOf(const Surface& s) {
    Surface sheen;
    sheen.position = s.position;
    sheen.to_viewer = s.to_viewer;
    sheen.normal = s.normal;
    sheen.geometric_normal = s.geometric_normal;
    sheen.dielectric_f90 = 0;
    sheen.occlusion = s.occlusion;
    sheen.sheen_color = s.sheen_color;
    sheen.sheen_roughness = s.sheen_roughness;
    return sheen;
}

Surface underSheen(const Surface& surface) {
    Surface s = surface;
    s.sheen_color = glm::dvec3(0);
    s.sheen_roughness = 0;
    return s;
}

double sheenAlbedoScaling(const Surface& s) {
    if (!hasSheen(s)) return 1;
    const double max = std::max({s.sheen_color.r, s.sheen_color.g, s.sheen_color.b});
    return std::max(0.0, 1 - max * sheenAlbedo(s.sheen_roughness, glm::dot(s.normal, s.to_viewer)));
}

SheenLobe::SheenLobe(double roughness, double n_dot_v) : n_dot_v_(std::clamp(n_dot_v, min_n_dot_v, 1.0)) {
    const double used = std::max(roughness, min_roughness), alpha = used * used;
    inverse_alpha_ = 1 / alpha;
    // The paper's section 3: from alpha = 1 to alpha = 0.
    const double t = (1 - alpha) * (1 - alpha);
    a_ = std::lerp(21.5473, 25.3245, t);
    b_ = std::lerp(3.82987, 3.32435, t);
    c_ = std::lerp(0.19823, 0.16801, t);
    d_ = std::lerp(-1.97760, -1.27393, t);
    e_ = std::lerp(-4.32054, -4.85967, t);
    lambda_v_ = lambda(n_dot_v_);
}

// The paper's equation 2.
double SheenLobe::distribution(double sine2) const {
    return (2 + inverse_alpha_) * std::pow(std::max(sine2, 0.0), inverse_alpha_ / 2) / (2 * std::numbers::pi);
}

// The paper's equation 3.
double SheenLobe::logarithm(double x) const {
    return a_ / (1 + b_ * std::pow(x, c_)) + d_ * x + e_;
}
double SheenLobe::lambda(double x) const {
    return std::exp(x < 0.5 ? logarithm(x) : 2 * logarithm(0.5) - logarithm(1 - x));
}

// Integrates over rings of directions with the same n.l, by the angle from the viewer's mirror direction.
// The lobe has a hole there, in which half vectors are near the normal. Its width is n.l + n.v, so the
// angle is a hyperbolic sine of even steps. The powers of n.l and 1 - n.l make the fit to Lambda smooth.
double sheenAlbedo(double roughness, double n_dot_v) {
    const SheenLobe lobe(roughness, n_dot_v);
    const double v = lobe.viewCosine(), view_sine = std::sqrt(1 - v * v);
    const auto ring = [&](double cosine) {
        const double sines = std::sqrt(1 - cosine * cosine) * view_sine, hole = cosine + v;
        const double end = std::asinh(std::numbers::pi / hole);
        double sum = 0;
        eachPoint(
            0, end,
            [&](double y, double step) {
                const double half = std::sin(hole * std::sinh(y) / 2),
                             l_dot_v = cosine * v + sines * (2 * half * half - 1);
                sum += lobe.distribution(1 - hole * hole / (2 * (1 + l_dot_v))) * hole * std::cosh(y) * step;
            },
            static_cast<int>(std::ceil(end / 6)));
        return 2 * sum * lobe.visibility(cosine);  // both halves
    };
    double sum = 0;
    eachPoint(0, 1, [&](double t, double step) {
        const double t4 = t * t * t * t;
        sum += ring(0.5 * t4 * t) * 2.5 * t4 * step + ring(1 - 0.5 * t * t) * t * step;
    });
    return sum;
}

}  // namespace diptych::reference
