// SPDX-License-Identifier: MIT
// Sampling of the specular lobe, or of a sheen.
#pragma once

#include "compare/reference/scattering/brdf.h"
#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::reference {

// Samples reflected directions, with half vectors distributed as D (n.h); Walter et al. 2007, equation 35.
// A sheen's lobe is wide but often at the horizon: samples all directions above it, denser near it.
class LobeSampler {
public:
    // An isotropic lobe. `normal`, `to_viewer`: unit; `alpha`: GGX's width.
    LobeSampler(const glm::dvec3& normal, const glm::dvec3& to_viewer, double alpha)
        : LobeSampler(normal, to_viewer, Widths{alpha, alpha}) {}
    explicit LobeSampler(const Brdf& brdf) : LobeSampler(brdf.normal(), brdf.toViewer(), brdf.widths()) {
        sheen_ = brdf.isSheen();
    }

    // u in [0, 1)^2. Returns a unit vector, which may be below the horizon.
    glm::dvec3 operator()(const glm::dvec2& u) const {
        if (sheen_) return raised(u.x * u.x, u.y);
        const glm::dvec3 h = widths_.isotropic() ? around(u) : stretched(u);
        return glm::normalize(2 * glm::dot(to_viewer_, h) * h - to_viewer_);
    }
    // 1/sr. Integrates to 1 over all directions: a facet that faces away from the viewer mirrors to below the
    // horizon, where it is opposite to the half vector.
    double density(const glm::dvec3& l) const {
        if (sheen_) {
            const double n_dot_l = glm::dot(normal_, l);
            return n_dot_l > 0 ? 1 / (4 * std::numbers::pi * std::sqrt(n_dot_l)) : 0;
        }
        const glm::dvec3 h = glm::normalize(l + to_viewer_);
        const double n_dot_h = std::abs(glm::dot(normal_, h)), v_dot_h = std::abs(glm::dot(to_viewer_, h));
        if (!(n_dot_h > 0) || !(v_dot_h > 0)) return 0;
        if (!widths_.isotropic()) {
            const double x = glm::dot(x_, h) / widths_.along, y = glm::dot(y_, h) / widths_.across,
                         k = x * x + y * y + n_dot_h * n_dot_h;
            return n_dot_h / (std::numbers::pi * widths_.along * widths_.across * k * k * 4 * v_dot_h);
        }
        const double k = n_dot_h * n_dot_h * (alpha2_ - 1) + 1;
        return alpha2_ * n_dot_h / (std::numbers::pi * k * k * 4 * v_dot_h);
    }

private:
    LobeSampler(const glm::dvec3& normal, const glm::dvec3& to_viewer, const Widths& widths)
        : normal_(normal),
          to_viewer_(to_viewer),
          widths_(widths),
          alpha2_(widths.across * widths.across),
          x_(widths.isotropic() ? perpendicularTo(normal) : widths.x),
          y_(glm::cross(normal, x_)) {}

    glm::dvec3 around(const glm::dvec2& u) const {
        return raised(std::sqrt((1 - u.x) / (1 + (alpha2_ - 1) * u.x)), u.y);
    }
    // By the cosine to the normal and the azimuth, in turns.
    glm::dvec3 raised(double cosine, double turns) const {
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), phi = 2 * std::numbers::pi * turns;
        return x_ * (sine * std::cos(phi)) + y_ * (sine * std::sin(phi)) + normal_ * cosine;
    }
    // Slopes of width 1, stretched by both widths.
    glm::dvec3 stretched(const glm::dvec2& u) const {
        const double r = std::sqrt(u.x / (1 - u.x)), phi = 2 * std::numbers::pi * u.y;
        return glm::normalize(x_ * (widths_.along * r * std::cos(phi)) +
                              y_ * (widths_.across * r * std::sin(phi)) + normal_);
    }

    glm::dvec3 normal_, to_viewer_;
    Widths widths_;
    double alpha2_;
    glm::dvec3 x_, y_;
    bool sheen_ = false;
};

}  // namespace diptych::reference
