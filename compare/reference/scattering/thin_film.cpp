// SPDX-License-Identifier: MIT
#include "compare/reference/scattering/thin_film.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diptych::reference {
namespace {

using std::numbers::pi;

double schlick(double f0, double cosine) {
    const double x = 1 - cosine;
    return f0 + (1 - f0) * squared(squared(x)) * x;
}

// A Gaussian of a CIE 1931 matching function over wavenumbers, fitted by the paper: height, middle (1/m)
// and variance (1/m^2).
struct Gaussian {
    double height, middle, variance;

    // Its Fourier transform at the path difference `phase` / (2 pi), m.
    double transformed(double phase, double shift) const {
        return height * std::sqrt(2 * pi * variance) * std::cos(middle * phase + shift) *
               std::exp(-variance * squared(phase));
    }
};

// Linear Rec. 709 of a cosine over wavenumbers. `path`: optical path difference, nm; `shift`: of each
// component, rad.
glm::dvec3 interference(double path, const glm::dvec3& shift) {
    constexpr Gaussian x1{5.4856e-13, 1.6810e6, 4.3278e9}, x2{9.7470e-14, 2.2399e6, 4.5282e9},
        y{4.4201e-13, 1.7953e6, 9.3046e9}, z{5.2481e-13, 2.2084e6, 6.6121e9};
    const double phase = 2 * pi * path * 1e-9;
    const double cie_x = (x1.transformed(phase, shift.x) + x2.transformed(phase, shift.x)) / 1.0685e-7,
                 cie_y = y.transformed(phase, shift.y) / 1.0685e-7,
                 cie_z = z.transformed(phase, shift.z) / 1.0685e-7;
    return {3.2404542 * cie_x - 1.5371385 * cie_y - 0.4985314 * cie_z,
            -0.9692660 * cie_x + 1.8760108 * cie_y + 0.0415560 * cie_z,
            0.0556434 * cie_x - 0.2040259 * cie_y + 1.0572252 * cie_z};
}

}  // namespace

// Airy's sum up to the second order.
glm::dvec3 ThinFilm::reflected(double cosine, const glm::dvec3& f0) const {
    const double outer = std::clamp(cosine, 0.0, 1.0);
    const double fraction = std::clamp(thickness / 0.03, 0.0, 1.0);  // a film fades out below 0.03 nm
    // Its upper face fades with it: Schlick's curve would reflect at grazing angles with air on both sides.
    const double present = squared(fraction) * (3 - 2 * fraction), n = std::lerp(1.0, ior, present);
    const double inner = std::sqrt(std::max(1 - (1 - squared(outer)) / squared(n), 0.0));
    const double top = present * schlick(squared((n - 1) / (n + 1)), outer), passed = 1 - top;
    glm::dvec3 bottom, shift;
    for (int c = 0; c < 3; ++c) {
        const double root = std::sqrt(std::clamp(f0[c], 0.0, 0.9999)), base = (1 + root) / (1 - root);
        bottom[c] = schlick(squared((base - n) / (base + n)), inner);
        shift[c] = base < n * (1 - 1e-5) ? 2 * pi : pi;  // as equal: indices that float32 may round apart
    }
    const glm::dvec3 cycle = glm::min(top * bottom, glm::dvec3(0.9999)),
                     within = squared(passed) * bottom / (1.0 - cycle);
    glm::dvec3 sum = top + within, order = within - passed;
    for (const double m : {1.0, 2.0}) {
        order *= glm::sqrt(cycle);
        sum += order * 2.0 * interference(m * 2 * n * thickness * inner, m * shift);
    }
    return glm::max(sum, glm::dvec3(0));
}

}  // namespace diptych::reference
