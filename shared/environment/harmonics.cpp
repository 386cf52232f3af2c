// SPDX-License-Identifier: MIT
#include "shared/environment/harmonics.h"

#include <tbb/parallel_for.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace diptych {

namespace {

// Normalization factors of the polynomials, by l (l + 1) + m.
const std::array<double, 9> norms{
    std::sqrt(1 / (4 * std::numbers::pi)),  std::sqrt(3 / (4 * std::numbers::pi)),
    std::sqrt(3 / (4 * std::numbers::pi)),  std::sqrt(3 / (4 * std::numbers::pi)),
    std::sqrt(15 / (4 * std::numbers::pi)), std::sqrt(15 / (4 * std::numbers::pi)),
    std::sqrt(5 / (16 * std::numbers::pi)), std::sqrt(15 / (4 * std::numbers::pi)),
    std::sqrt(15 / (16 * std::numbers::pi))};

std::array<double, 9> polynomials(const glm::dvec3& d) {
    return {1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
}

int bandOf(std::size_t i) {
    return i < 1 ? 0 : i < 4 ? 1 : 2;
}

// Per row and component: integrals over azimuth of radiance times e^(i m azimuth), m = 0 to 2. They are
// exact for linear interpolation between pixel centres.
using Moments = std::array<std::array<std::complex<double>, 3>, 3>;

// Per column centre: e^(i m azimuth), m = 1 and 2.
using Turns = std::array<std::complex<double>, 2>;

std::vector<Turns> turnsOf(int width) {
    std::vector<Turns> turns;
    for (int x = 0; x < width; ++x) {
        const double azimuth = 2 * std::numbers::pi * (x + 0.5) / width - std::numbers::pi;
        turns.push_back({std::polar(1.0, azimuth), std::polar(1.0, 2 * azimuth)});
    }
    return turns;
}

Moments momentsOf(const Image& image, int y, const std::vector<Turns>& turns) {
    Moments moments{};
    const double step = 2 * std::numbers::pi / image.width;
    for (int x = 0; x < image.width; ++x) {
        const Turns& turn = turns[static_cast<std::size_t>(x)];
        for (std::size_t c = 0; c < 3; ++c) {
            const double value = image.at(x, y, static_cast<int>(c));
            moments[c][0] += value;
            moments[c][1] += value * turn[0];
            moments[c][2] += value * turn[1];
        }
    }
    for (auto& component : moments)
        for (std::size_t m = 0; m < 3; ++m) {
            const double half = static_cast<double>(m) * step / 2, sinc = m == 0 ? 1 : std::sin(half) / half;
            component[m] *= step * sinc * sinc;
        }
    return moments;
}

// Moments of the row rotated by half of its columns, as it continues beyond a pole.
Moments turned(Moments moments, int width) {
    for (auto& component : moments)
        for (std::size_t m = 0; m < 3; ++m)
            component[m] *=
                std::polar(1.0, -static_cast<double>(m) * 2 * std::numbers::pi / width * (width / 2));
    return moments;
}

// Adds the moments' contribution at a polar angle, times `weight`.
void add(Harmonics& sum, const Moments& moments, double polar, double weight) {
    const double s = std::sin(polar), c = std::cos(polar);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<int>(i);
        const auto& m = moments[i];
        // x = s sin(azimuth), y = c, z = -s cos(azimuth).
        const double one = m[0].real(), sine = m[1].imag(), cosine = m[1].real(), sine2 = m[2].imag(),
                     cosine2 = m[2].real();
        const std::array<double, 9> integrals{one,
                                              c * one,
                                              -s * cosine,
                                              s * sine,
                                              s * c * sine,
                                              -s * c * cosine,
                                              1.5 * s * s * (one + cosine2) - one,
                                              -0.5 * s * s * sine2,
                                              0.5 * s * s * (one - cosine2) - c * c * one};
        for (std::size_t k = 0; k < 9; ++k) sum[k][axis] += weight * norms[k] * integrals[k];
    }
}

}  // namespace

Harmonics project(const LatLong& light) {
    const Image& image = light.image();
    const auto height = static_cast<std::size_t>(image.height);
    std::vector<Moments> rows(height);
    const std::vector<Turns> turns = turnsOf(image.width);
    tbb::parallel_for(std::size_t{0}, height,
                      [&](std::size_t y) { rows[y] = momentsOf(image, static_cast<int>(y), turns); });
    // Integrates between row centres, and to the poles, by 3-point Gauss-Legendre.
    constexpr std::array<double, 3> at{0.112701665379258, 0.5, 0.887298334620742},
        part{5 / 18.0, 8 / 18.0, 5 / 18.0};
    const double step = std::numbers::pi / image.height;
    Harmonics sum{};
    const auto between = [&](const Moments& above, const Moments& below, double from, double first,
                             double last) {
        // `from`: polar angle of the upper centre. Integrates the fraction [first, last] of the way to the
        // lower one, in pieces that resolve the sine when there are few rows.
        constexpr int pieces = 8;
        for (int piece = 0; piece < pieces; ++piece)
            for (std::size_t i = 0; i < at.size(); ++i) {
                const double width = (last - first) / pieces, t = first + width * (piece + at[i]);
                const double polar = from + step * t, weight = width * part[i] * step * std::sin(polar);
                add(sum, above, polar, weight * (1 - t));
                add(sum, below, polar, weight * t);
            }
    };
    between(turned(rows.front(), image.width), rows.front(), -step / 2, 0.5, 1);
    for (std::size_t y = 0; y + 1 < height; ++y)
        between(rows[y], rows[y + 1], step * (static_cast<double>(y) + 0.5), 0, 1);
    between(rows.back(), turned(rows.back(), image.width), std::numbers::pi - step / 2, 0, 0.5);
    return sum;
}

std::array<glm::dvec3, 9> irradiancePolynomial(const Harmonics& radiance, double window) {
    // Coefficients of the clamped cosine over pi, by band.
    constexpr std::array<double, 3> cosine{1, 2 / 3.0, 1 / 4.0};
    std::array<glm::dvec3, 9> result;
    for (std::size_t i = 0; i < 9; ++i) {
        const double l = bandOf(i);
        result[i] = radiance[i] * (norms[i] * cosine[static_cast<std::size_t>(bandOf(i))] /
                                   (1 + window * l * l * (l + 1) * (l + 1)));
    }
    return result;
}

// Rotates a linear form and a traceless quadratic form: for unit length, 3 z^2 - 1 is 2 z^2 - x^2 - y^2.
std::array<glm::dvec3, 9> rotatedPolynomial(const std::array<glm::dvec3, 9>& polynomial,
                                            const glm::dmat3& rotation) {
    std::array<glm::dvec3, 9> result;
    for (int c = 0; c < 3; ++c) {
        const auto of = [&](std::size_t i) { return polynomial[i][c]; };
        const glm::dmat3 form(of(8) - of(6), of(4) / 2, of(7) / 2, of(4) / 2, -of(8) - of(6), of(5) / 2,
                              of(7) / 2, of(5) / 2, 2 * of(6));
        const glm::dmat3 q = glm::transpose(rotation) * form * rotation;
        const glm::dvec3 g = glm::transpose(rotation) * glm::dvec3(of(3), of(1), of(2));
        const std::array<double, 9> turned{
            of(0), g.y, g.z, g.x, 2 * q[0][1], 2 * q[1][2], q[2][2] / 2, 2 * q[0][2], -q[1][1] - q[2][2] / 2};
        for (std::size_t i = 0; i < 9; ++i) result[i][c] = turned[i];
    }
    return result;
}

glm::dvec3 evaluate(const std::array<glm::dvec3, 9>& polynomial, const glm::dvec3& normal) {
    const std::array<double, 9> values = polynomials(normal);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 9; ++i) sum += polynomial[i] * values[i];
    return sum;
}

double minWindow(const Harmonics& radiance) {
    const auto isNegative = [&](double window) {
        const auto polynomial = irradiancePolynomial(radiance, window);
        constexpr int count = 2000;
        for (int i = 0; i < count; ++i) {
            // Fibonacci spiral.
            const double y = 1 - (2 * i + 1.0) / count, s = std::sqrt(1 - y * y),
                         turn = 2.399963229728653 * i;
            const glm::dvec3 e = evaluate(polynomial, {s * std::cos(turn), y, s * std::sin(turn)});
            if (std::min({e.x, e.y, e.z}) < 0) return true;
        }
        return false;
    };
    if (!isNegative(0)) return 0;
    double low = 1e-4, high = 1e-4;
    while (isNegative(high) && high < 1e4) low = std::exchange(high, high * 2);
    while (high > 1.01 * low) {
        const double middle = std::sqrt(low * high);
        (isNegative(middle) ? low : high) = middle;
    }
    return high;
}

}  // namespace diptych
