// SPDX-License-Identifier: MIT
// Irradiance of an environment by real spherical harmonics up to order 2 (Ramamoorthi and Hanrahan 2001, "An
// Efficient Representation for Irradiance Environment Maps").
#pragma once

#include "shared/environment/lat_long.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace diptych {

// By l (l + 1) + m: 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2, each with its factor that makes it
// orthonormal over the sphere.
using Harmonics = std::array<glm::dvec3, 9>;

// The projection of the radiance, integrated over the bilinear interpolation; W/(sr m^2).
Harmonics project(const LatLong& light);

// Irradiance over pi, in the plain polynomials of contract/environment.h. `window`: bands l are multiplied by
// 1 / (1 + window l^2 (l + 1)^2) (Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks").
std::array<glm::dvec3, 9> irradiancePolynomial(const Harmonics& radiance, double window = 0);
// The same of the light turned: its value for a normal is that of `polynomial` for rotation * normal.
std::array<glm::dvec3, 9> turnedPolynomial(const std::array<glm::dvec3, 9>& polynomial,
                                           const glm::dmat3& rotation);
glm::dvec3 evaluate(const std::array<glm::dvec3, 9>& polynomial, const glm::dvec3& normal);

// The least window, within 1 %, with which no component of the irradiance is negative in any of some thousand
// directions; 0 where none is without one.
double leastWindow(const Harmonics& radiance);

}  // namespace diptych
