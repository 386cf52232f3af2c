// SPDX-License-Identifier: MIT
// Irradiance of an environment by real spherical harmonics up to order 2 (Ramamoorthi and Hanrahan 2001, "An
// Efficient Representation for Irradiance Environment Maps").
#pragma once

#include "shared/environment/lat_long.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace diptych {

// Coefficients by index l (l + 1) + m: 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2, each with the factor
// that makes it orthonormal over the sphere.
using Harmonics = std::array<glm::dvec3, 9>;

// Projection of the radiance, integrated with bilinear interpolation; W/(sr m^2).
Harmonics project(const LatLong& light);

// Irradiance / pi, in the unnormalized polynomials of contract/environment.h. `window`: band l is
// multiplied by 1 / (1 + window l^2 (l + 1)^2) (Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks").
std::array<glm::dvec3, 9> irradiancePolynomial(const Harmonics& radiance, double window = 0);
// Rotated light: the value for a normal is that of `polynomial` for rotation * normal.
std::array<glm::dvec3, 9> rotatedPolynomial(const std::array<glm::dvec3, 9>& polynomial,
                                            const glm::dmat3& rotation);
glm::dvec3 evaluate(const std::array<glm::dvec3, 9>& polynomial, const glm::dvec3& normal);

// Smallest window, within 1 %, for which no component of irradiance is negative in 2000 directions; 0 if
// none is negative without a window.
double minWindow(const Harmonics& radiance);

}  // namespace diptych
