// SPDX-License-Identifier: MIT
// Display colours as readers with normal, protan and deutan vision see them.
#pragma once

#include "tests/support/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace diptych {

using Rgb8 = std::array<std::uint8_t, 3>;

struct ColorVision {
    const char* name;
    std::array<std::array<double, 3>, 3> seen_from_linear;  // linear sRGB
};
// Machado, Oliveira and Fernandes 2009, "A Physiologically-based Model for Simulation of Color Vision
// Deficiency", severity 1.
inline constexpr ColorVision colorVisions[] = {
    {"normal", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    {"protan",
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
    {"deutan",
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}}};

inline std::array<double, 3> linearOf(const Rgb8& color) {
    std::array<double, 3> linear{};
    for (std::size_t c = 0; c < 3; ++c) linear[c] = decodedSrgb(color[c] / 255.0);
    return linear;
}

// CIELAB (CIE 15) with the white of sRGB.
inline std::array<double, 3> labOf(const Rgb8& color, const ColorVision& vision) {
    const std::array<double, 3> linear = linearOf(color);
    std::array<double, 3> seen{};
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < 3; ++k) seen[c] += vision.seen_from_linear[c][k] * linear[k];
        seen[c] = std::clamp(seen[c], 0.0, 1.0);
    }
    const auto part = [&](double r, double g, double b) {
        const double t = (r * seen[0] + g * seen[1] + b * seen[2]) / (r + g + b);
        return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    };
    const double x = part(0.4124564, 0.3575761, 0.1804375), y = part(0.2126729, 0.7151522, 0.0721750),
                 z = part(0.0193339, 0.1191920, 0.9503041);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// CIE 1976 colour difference.
inline double distance(const Rgb8& a, const Rgb8& b, const ColorVision& vision) {
    const std::array<double, 3> p = labOf(a, vision), q = labOf(b, vision);
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// WCAG 2.2, relative luminance.
inline double contrastOf(const Rgb8& a, const Rgb8& b) {
    const auto luminance = [](const Rgb8& color) {
        const std::array<double, 3> l = linearOf(color);
        return 0.2126 * l[0] + 0.7152 * l[1] + 0.0722 * l[2];
    };
    const double p = luminance(a), q = luminance(b);
    return (std::max(p, q) + 0.05) / (std::min(p, q) + 0.05);
}

}  // namespace diptych
