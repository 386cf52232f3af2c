// SPDX-License-Identifier: MIT
// Closed forms of materials and their layers from their papers. They share nothing with the reference or the
// shaders.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace diptych {

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering". A clear coat's, and that of an
// index of 1.5, unless stated.
inline double schlick(double cosine, double f0 = 0.04, double f90 = 1) {
    return f0 + (f90 - f0) * std::pow(1 - cosine, 5);
}

// f n.l of GGX with F = 1 in a frame of x, y and the normal +Z. `widths`: alpha along x and y. Burley 2012,
// equation 13, and Heitz 2014, equations 80 and 99, as a product of both directions' lengths in the
// stretched frame.
inline double stretchedLobe(const glm::dvec2& widths, const glm::dvec3& l, const glm::dvec3& v) {
    const auto length = [&](const glm::dvec3& d) {
        return std::sqrt(std::pow(widths.x * d.x, 2) + std::pow(widths.y * d.y, 2) + d.z * d.z);
    };
    const glm::dvec3 h = glm::normalize(l + v);
    const double k = std::pow(h.x / widths.x, 2) + std::pow(h.y / widths.y, 2) + h.z * h.z;
    return l.z * 0.5 / (l.z * length(v) + v.z * length(l)) / (std::numbers::pi * widths.x * widths.y * k * k);
}

// D of Trowbridge and Reitz 1975 (GGX).
inline double ggx(double alpha, double n_dot_h) {
    const double t = n_dot_h * n_dot_h * (alpha * alpha - 1) + 1;
    return alpha * alpha / (std::numbers::pi * t * t);
}

// Directions of light for a viewer in the xz plane, and weights that integrate over the hemisphere. Changes
// variables to half vectors distributed as D (n.h) (Walter et al. 2007), so that sharp lobes converge: dl =
// 4 (v.h) dh. `sectors` over half a turn; the other half is its mirror image.
struct WeightedDirection {
    glm::dvec3 to_light;
    double weight;
};
inline std::vector<WeightedDirection> reflectedDirections(const glm::dvec3& v, double alpha, int rings,
                                                          int sectors) {
    std::vector<WeightedDirection> directions;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double u = (i + 0.5) / rings, phi = std::numbers::pi * (j + 0.5) / sectors;
            const double nh = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u)),
                         sine = std::sqrt(1 - nh * nh);
            const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), nh);
            const double vh = glm::dot(v, h);
            const glm::dvec3 l = 2 * vh * h - v;
            if (vh > 0 && l.z > 0)
                directions.push_back({l, 4 * vh / (ggx(alpha, nh) * nh * rings * sectors)});
        }
    return directions;
}

// GGX with F = 1 and height-correlated Smith masking: albedo seen straight on, and the white furnace's loss,
// averaged over all directions of light and viewer, cosine-weighted; three digits.
struct WhiteMetal {
    double roughness, value;
};
inline constexpr WhiteMetal whiteAlbedos[] = {{0.5, 0.9158}, {1.0, 0.3069}},
                            whiteLosses[] = {{0.2, 0.0059}, {0.4, 0.0597}, {0.5, 0.118},
                                             {0.6, 0.197},  {0.8, 0.396},  {1.0, 0.591}};

// A sheen's D V n.l: Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", equations 2 and 3
// and table 1.
inline double estevezKulla(double roughness, double n_dot_l, double n_dot_v, double n_dot_h) {
    const double used = std::max(roughness, 0.045), alpha = used * used, smooth = std::pow(1 - alpha, 2);
    constexpr std::array rough{21.5473, 3.82987, 0.19823, -1.97760, -4.32054},
        fine{25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
    std::array<double, 5> p{};
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = (1 - smooth) * rough[i] + smooth * fine[i];
    const auto fit = [&](double x) { return p[0] / (1 + p[1] * std::pow(x, p[2])) + p[3] * x + p[4]; };
    const auto lambda = [&](double x) {
        return x < 0.5 ? std::exp(fit(x)) : std::exp(2 * fit(0.5) - fit(1 - x));
    };
    const double sine = std::sqrt(std::max(1 - n_dot_h * n_dot_h, 0.0));
    return (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * std::numbers::pi) /
           ((1 + lambda(n_dot_v) + lambda(n_dot_l)) * 4 * n_dot_v);
}

// Its integral over the hemisphere as a dense sum, by the angle from the direction opposite the viewer's.
inline double denseSheenAlbedo(double roughness, double n_dot_v) {
    constexpr double pi = std::numbers::pi;
    constexpr int steps = 300;
    double sum = 0;
    const auto add = [&](double z, double weight) {
        for (int j = 0; j < steps; ++j) {
            const double w = (j + 0.5) / steps, phi = pi * (1 - w * w * w);
            const double cosine =
                z * n_dot_v + std::sqrt((1 - z * z) * (1 - n_dot_v * n_dot_v)) * std::cos(phi);
            sum += estevezKulla(roughness, z, n_dot_v, (z + n_dot_v) / std::sqrt(2 + 2 * cosine)) * weight *
                   6 * pi * w * w / steps;
        }
    };
    for (int i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps;
        add(0.5 * std::pow(u, 5), 2.5 * std::pow(u, 4) / steps);
        add(1 - 0.5 * u * u, u / steps);
    }
    return sum;
}

// Linear Rec. 709 of cos(2 pi wavenumber path + phase), path in m, by the Gaussians over wavenumbers of
// Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying
// Iridescence". Their variances are twice those of the transforms, which glTF's text has. `phase`: of X, Y
// and Z.
inline glm::dvec3 spectralSum(double path, const glm::dvec3& phase = glm::dvec3(0)) {
    const auto integral = [&](double value, double middle, double variance, double shift) {
        constexpr int steps = 2000;
        const double reach = 10 * std::sqrt(2 * variance);
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double x = reach * ((2 * i + 1.0) / steps - 1);
            sum += std::exp(-x * x / (4 * variance)) *
                   std::cos(2 * std::numbers::pi * (middle + x) * path + shift);
        }
        return value / std::sqrt(2.0) * sum * 2 * reach / steps / 1.0685e-7;
    };
    const double x = integral(5.4856e-13, 1.6810e6, 4.3278e9, phase.x) +
                     integral(9.7470e-14, 2.2399e6, 4.5282e9, phase.x),
                 y = integral(4.4201e-13, 1.7953e6, 9.3046e9, phase.y),
                 z = integral(5.2481e-13, 2.2084e6, 6.6121e9, phase.z);
    return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
            0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

}  // namespace diptych
