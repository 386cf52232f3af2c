// SPDX-License-Identifier: MIT
#include "compare/reference/scattering/ambient.h"

#include "compare/reference/scattering/gauss_legendre.h"
#include "compare/reference/scattering/sheen.h"
#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace diptych::reference {
namespace {

// In a frame with the normal +Z and the viewer in the plane y = 0.
class Integrals {
public:
    Integrals(const Surface& surface, const Compensation& compensation)
        : brdf_(framed(surface), compensation), parts_(surface.iridescence > 0 ? 2 : 1) {}

    // All but the GGX lobe: integrates over the projected hemisphere. By symmetry one half is enough.
    Reflected smooth() const {
        Reflected sum;
        each(0, 1, [&](double square, double step) {
            const double cosine = std::sqrt(square), sine = std::sqrt(1 - square);
            each(0, std::numbers::pi, [&](double phi, double weight) {
                const glm::dvec3 l(sine * std::cos(phi), sine * std::sin(phi), cosine);
                Reflected f = brdf_(l);
                f.specular -= brdf_.lobe(l);
                sum += f * (step * weight / cosine);  // d(cos^2) dphi is 2 cos dl; both halves
            });
        });
        return sum;
    }

    // The GGX lobe: integrates over rings of half vectors, by the tangent of their angle to the normal.
    // There are three ranges: up to the first ring that reflects light from below the horizon, from there
    // to the lobe's width, and up to the first ring that reflects only such light.
    glm::dvec3 lobe() const {
        if (!brdf_.widths().isotropic()) return stretchedLobe();
        const double view = std::acos(std::min(brdf_.toViewer().z, 1.0)), right = std::numbers::pi / 2;
        const double whole = std::tan((right - view) / 2), none = std::tan((right + view) / 2);
        const double alpha = brdf_.widths().across, width = std::clamp(alpha, whole, none);
        glm::dvec3 sum(0);
        const auto add = [&](double tangent, double step) {
            sum += ring(std::atan(tangent)) * (step / (1 + tangent * tangent));
        };
        // sinh substitution: even steps near the middle of the lobe, logarithmic steps far out.
        each(0, std::asinh(whole / alpha),
             [&](double y, double step) { add(alpha * std::sinh(y), alpha * std::cosh(y) * step); });
        // Cubic substitution: resolves the ends of the interval, where rings begin and cease to
        // contribute. Far out the lobe is smooth in the cotangent.
        each(0, 1, [&](double t, double step) {
            const double cube = t * t * t, slope = 3 * t * t * step;
            add(whole + (width - whole) * cube, (width - whole) * slope);
            const double cotangent = 1 / none + (1 / width - 1 / none) * cube;
            add(1 / cotangent, (1 / width - 1 / none) * slope / (cotangent * cotangent));
        });
        return sum;
    }

private:
    template <class F>
    void each(double from, double to, const F& f) const {
        eachPoint(from, to, f, parts_);
    }

    static Surface framed(Surface s) {
        constexpr double min = 1e-4;  // n.v, as in the material (README.md, "The model")
        const double cosine = std::clamp(glm::dot(s.normal, s.to_viewer), min, 1.0);
        if (s.anisotropy > 0) {
            const glm::dvec3 along = s.anisotropy_direction;
            const glm::dvec3 x = unitOr(s.to_viewer - s.normal * glm::dot(s.normal, s.to_viewer), along);
            s.anisotropy_direction =
                glm::normalize(glm::dvec3(glm::dot(along, x), glm::dot(along, glm::cross(s.normal, x)), 0));
        }
        s.normal = {0, 0, 1};
        s.to_viewer = {std::sqrt(1 - cosine * cosine), 0, cosine};
        return s;
    }

    // The anisotropic lobe: integrates over slopes of half vectors, divided by the widths, by sectors.
    // Sectors end where half vectors begin to turn away from the viewer, and at both axes of the lobe.
    glm::dvec3 stretchedLobe() const {
        const Widths& w = brdf_.widths();
        const glm::dvec3 v = brdf_.toViewer();
        constexpr double right = std::numbers::pi / 2;
        const double start = std::atan2(w.across * glm::dot(w.y, v), w.along * glm::dot(w.x, v)) - right;
        std::array<double, 7> ends{start, start + 2 * right, start + 4 * right};
        for (int i = 0; i < 4; ++i)
            ends[static_cast<std::size_t>(3 + i)] = right * (std::ceil(start / right) + i);
        std::ranges::sort(ends);
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i + 1 < ends.size(); ++i)
            each(ends[i], ends[i + 1],
                 [&](double azimuth, double step) { sum += alongSlope(azimuth) * step; });
        return sum;
    }

    // Integrates over the half vectors of one direction of the stretched slopes, by the angle whose tangent
    // is their length. Light from above the horizon has slopes in a circle around the viewer's with the
    // radius 1 / n.v; its end is a root of a quadratic equation.
    glm::dvec3 alongSlope(double azimuth) const {
        const Widths& w = brdf_.widths();
        const glm::dvec3 v = brdf_.toViewer();
        const glm::dvec3 slope = w.x * (w.along * std::cos(azimuth)) + w.y * (w.across * std::sin(azimuth));
        const double a = glm::dot(slope, slope), b = glm::dot(slope, v) / v.z, root = std::sqrt(b * b + a);
        const double last = std::atan(b > 0 ? (b + root) / a : 1 / (root - b));
        glm::dvec3 sum(0);
        each(0, 1, [&](double t, double step) {
            const double left = 1 - t, angle = last * (1 - left * left * left);  // denser at the horizon
            const double r = std::tan(angle), cosine = 1 / std::sqrt(1 + r * r * a);
            const glm::dvec3 h = (slope * r + glm::dvec3(0, 0, 1)) * cosine;
            const double v_dot_h = glm::dot(v, h);
            // dl = 4 v.h dh; dh = cosine^3 dslope; dr = (1 + r^2) dangle
            sum += brdf_.lobe(2 * v_dot_h * h - v) *
                   (4 * v_dot_h * cosine * cosine * cosine * w.along * w.across * r * (1 + r * r) * 3 * last *
                    left * left * step);
        });
        return sum;
    }

    // Integrates over the half vectors of one ring (`angle` from the normal) whose light is above the
    // horizon.
    glm::dvec3 ring(double angle) const {
        const glm::dvec3 v = brdf_.toViewer();
        const double c = std::cos(angle), s = std::sin(angle);
        // n.l = 2 (v.h) c - v.z > 0
        const double edge = (v.z / (2 * c) - v.z * c) / std::max(v.x * s, 1e-300);
        glm::dvec3 sum(0);
        each(0, std::acos(std::clamp(edge, -1.0, 1.0)), [&](double phi, double weight) {
            const glm::dvec3 h(s * std::cos(phi), s * std::sin(phi), c);
            const double v_dot_h = glm::dot(v, h);
            sum += brdf_.lobe(2 * v_dot_h * h - v) * (4 * v_dot_h * weight);  // dl = 4 v.h dh
        });
        return sum * (2 * s);  // dh = sin(angle) d(angle) dphi; factor 2 for both halves
    }

    Brdf brdf_;
    int parts_;  // of each interval: a film's reflectance has waves
};

}  // namespace

glm::dvec3 diffuseAlbedo(const Surface& surface, const Compensation& compensation) {
    if (hasSheen(surface)) return glm::dvec3(0);
    return Integrals(surface, compensation).smooth().diffuse;
}

glm::dvec3 specularAlbedo(const Surface& surface, const Compensation& compensation) {
    if (hasSheen(surface))
        return surface.sheen_color *
               sheenAlbedo(surface.sheen_roughness, glm::dot(surface.normal, surface.to_viewer));
    const Integrals integrals(surface, compensation);
    const glm::dvec3 lobe = integrals.lobe();
    return compensation.between == glm::dvec3(0) ? lobe : lobe + integrals.smooth().specular;
}

}  // namespace diptych::reference
