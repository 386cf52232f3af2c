// SPDX-License-Identifier: MIT
// Directional albedo: integrals of the BRDF of shaders/lib/shading/brdf.glsl over uniform light.
// shaders/lib/shading/ambient.glsl reads a table of them.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace diptych {

// Integral of D V n.l over the hemisphere of light directions, split by Schlick's weight w = (1 - v.h)^5.
// x is the integral with 1 - w, the factor of F0; y is the integral with w, the factor of F90. `n_dot_v`
// in (0, 1], `alpha` in (0, 1]. The error of the sum is at most 5e-6.
glm::dvec2 specularAlbedo(double n_dot_v, double alpha);

// Table of shared/contract/albedo.h, row by row; computed on first use, on all cores.
const std::vector<glm::vec2>& directionalAlbedoTable();
// As shaders read it: pairs of each sample and the next; the last is paired with itself.
std::vector<glm::vec4> directionalAlbedoPairs();

}  // namespace diptych
