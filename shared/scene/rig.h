// SPDX-License-Identifier: MIT
// Lights that a scene does not bring itself.
#pragma once

#include "shared/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

// The uint32 hash of SCENE-spheres: PCG's output permutation over one LCG step (O'Neill 2014; Jarzynski
// and Olano 2020). u01(i) = pcg(i) / 2^32 in double.
std::uint32_t pcg(std::uint32_t i);
double u01(std::uint32_t i);

// `lights` is Settings::lights: "KIND:N[,KIND:N...]" with KIND point or spot (area is named as not built
// yet), seeded, scattered in `bounds`; or the name of a JSON file { "lights": [...] }. Returns world lights.
// Throws std::runtime_error naming --lights or the file, the light's index and the fault.
std::vector<Light> makeLights(const std::string& lights, std::uint32_t seed, const Bounds& bounds);

// A sun of 3 lux for a scene that has neither lights nor environment.
Light defaultSun();

}  // namespace diptych
