// SPDX-License-Identifier: MIT
// Directional albedo of the sheen of shaders/lib/shading/sheen.glsl, which reads a table of it.
#pragma once

#include <glm/vec4.hpp>

#include <vector>

namespace diptych {

// E(n.v): the integral of D V n.l over the hemisphere of light directions. `n_dot_v` in [1e-4, 1],
// `roughness` (perceptual) in [0.045, 1]. The error is at most 1e-5.
double sheenAlbedo(double n_dot_v, double roughness);

// The table of shared/contract/albedo.h as shaders read it, computed on first use, on all cores.
const std::vector<glm::vec4>& sheenAlbedoRows();

}  // namespace diptych
