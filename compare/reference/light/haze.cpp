// SPDX-License-Identifier: MIT
#include "compare/reference/light/haze.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace diptych::reference {
namespace {

constexpr std::size_t gauss_nodes = 8;
// Gauss-Legendre on [0, 1].
constexpr std::array<double, gauss_nodes> gauss_node{
    0.019855071751231884, 0.10166676129318664, 0.23723379504183550, 0.40828267875217510,
    0.59171732124782490,  0.76276620495816450, 0.89833323870681336, 0.98014492824876812};
constexpr std::array<double, gauss_nodes> gauss_weight{
    0.050614268145188130, 0.11119051722668724, 0.15685332293894364, 0.18134189168918100,
    0.18134189168918100,  0.15685332293894364, 0.11119051722668724, 0.050614268145188130};

constexpr double no_depth = 1e-15;  // optical depth that changes nothing
constexpr double opaque = 110;      // optical depth beyond float32: e^-104 is its smallest transmittance

double densityOf(const AirKind& kind, double height) {
    return std::exp(std::min(-height / kind.scale, 60.0));
}
glm::dvec3 extinctionOf(const Air& air, double height) {
    return air.molecules.extinction * densityOf(air.molecules, height) +
           air.aerosols.extinction * densityOf(air.aerosols, height);
}
double max(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}
double all(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

// The length of the panel of a ray at `height` and `depth`: at most `step`, one scale height of either kind,
// and one optical depth of a visible component.
double panelFrom(const Air& air, double height, double up, double step, const glm::dvec3& depth) {
    const glm::dvec3 here = extinctionOf(air, height);
    for (int c = 0; c < 3; ++c)
        if (here[c] > 0 && depth[c] < opaque) step = std::min(step, 1 / here[c]);
    const bool molecules_last = air.molecules.scale > air.aerosols.scale;
    for (const bool first : {true, false}) {
        const AirKind& kind = first == molecules_last ? air.molecules : air.aerosols;
        const double low = height + std::min(up, 0.0) * std::min(step, 1e300);
        const double there = max(kind.extinction) * densityOf(kind, low);
        if (up != 0 && (std::isinf(step) || there * step > no_depth))
            step = std::min(step, kind.scale / std::abs(up));
    }
    return step;
}

}  // namespace

Haze::Haze(const Air& air, const glm::dvec3& eye) : air_(air), eye_height_(eye.y - air.ground) {
    if (air_.uniform) {
        const double m = all(air.molecules.extinction), a = all(air.aerosols.extinction);
        if (m + a > 0)
            air_.molecules.scale = air_.aerosols.scale =
                (m * air.molecules.scale + a * air.aerosols.scale) / (m + a);
    }
    if (!air.sun) return;
    to_sun_ = -glm::normalize(air.sun->direction);
    irradiance_ = glm::dvec3(air.sun->color) * double{air.sun->intensity};
    sun_up_ = std::max(to_sun_.y, 0.0);
    if (sun_up_ > 0) sunlight_ = glm::exp(-above(eye_height_) / sun_up_);
}

glm::dvec3 Haze::above(double height) const {
    glm::dvec3 depth(0);
    for (const AirKind* const kind : {&air_.molecules, &air_.aerosols})
        for (int panel = 0; panel < 40; ++panel)
            for (std::size_t i = 0; i < gauss_nodes; ++i)
                depth +=
                    kind->extinction * (densityOf(*kind, height + kind->scale * (panel + gauss_node[i])) *
                                        gauss_weight[i] * kind->scale);
    return depth;
}

Hazed Haze::along(const glm::dvec3& origin, const glm::dvec3& away, double reach) const {
    const double start = eye_height_ + origin.y, up = away.y;
    const double cosine = glm::dot(away, to_sun_), both = 1 + cosine * cosine, g = air_.g;
    const double rayleigh = 3 / (16 * std::numbers::pi) * both;
    const double mie = 3 / (8 * std::numbers::pi) * (1 - g * g) * both /
                       ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    const bool dimmed = sun_up_ > 0 && !air_.uniform;
    const glm::dvec3 overhead = dimmed ? above(start) : glm::dvec3(0);
    // Density is exponential in height alone, so the optical depth to the sun falls by the ray's own
    // optical depth, scaled by the two slopes.
    const auto sunlight = [&](const glm::dvec3& depth) {
        if (!dimmed) return sunlight_;
        return glm::exp(-glm::max((overhead - depth * up) / sun_up_, glm::dvec3(0)));
    };

    glm::dvec3 depth(0), scattered(0);
    for (double t = 0; t < reach;) {
        const double step = panelFrom(air_, start + up * t, up, reach - t, depth);
        if (std::isinf(step)) break;  // there is no air
        glm::dvec3 here(0);
        for (std::size_t i = 0; i < gauss_nodes; ++i) {
            const double part = step * gauss_node[i], height = start + up * (t + part);
            glm::dvec3 to_node(0);
            for (std::size_t k = 0; k < gauss_nodes; ++k)
                to_node +=
                    extinctionOf(air_, start + up * (t + part * gauss_node[k])) * (gauss_weight[k] * part);
            const glm::dvec3 m = air_.molecules.scattering * densityOf(air_.molecules, height),
                             a = air_.aerosols.scattering * densityOf(air_.aerosols, height);
            const glm::dvec3 light = irradiance_ * sunlight(depth + to_node);
            const glm::dvec3 sent = light * (m * rayleigh + a * mie) + air_.ambient * (m + a);
            scattered += sent * glm::exp(-(depth + to_node)) * (gauss_weight[i] * step);
            here += extinctionOf(air_, height) * (gauss_weight[i] * step);
        }
        depth += here;
        t += step;
        bool seen = false;
        for (int c = 0; c < 3; ++c)
            seen =
                seen || (depth[c] < opaque && air_.molecules.extinction[c] + air_.aerosols.extinction[c] > 0);
        if (!seen) break;
        if (std::isinf(reach) && up > 0 && max(here) < no_depth) break;
    }
    Hazed hazed{glm::exp(-depth), scattered};
    if (std::isinf(reach) && up <= 0)
        for (int c = 0; c < 3; ++c)
            if (air_.molecules.extinction[c] + air_.aerosols.extinction[c] > 0) hazed.transmittance[c] = 0;
    return hazed;
}

}  // namespace diptych::reference
