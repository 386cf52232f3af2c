// SPDX-License-Identifier: MIT
// What a surface reflects of light that is the same from everywhere: the integrals of the BRDF that
// shaders/lib/brdf.glsl evaluates, of which shaders/lib/ambient.glsl reads a table.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace diptych {

// The integral of D V n.l over the hemisphere of light, split by Schlick's weight w = (1 - v.h)^5: x is that
// of 1 - w, what F0 is multiplied by; y that of w, F90's factor. `n_dot_v` in (0, 1], `alpha` in (0, 1].
// Within 5e-6 of the sum.
glm::dvec2 specularAlbedo(double n_dot_v, double alpha);

// The table of shared/contract/albedo.h, row after row; made on all cores when it is first asked for.
const std::vector<glm::vec2>& directionalAlbedoTable();
// As shaders read it: each sample with the next one, the last with itself.
std::vector<glm::vec4> directionalAlbedoPairs();

}  // namespace diptych
