// SPDX-License-Identifier: MIT
// The probes, by group.
#pragma once

#include "compare/probe/probe.h"

namespace diptych::probe {

std::vector<Probe> operationProbes();  // device operations
std::vector<Probe> brdfProbes();       // D, the specular lobe, F
std::vector<Probe> lightProbes();      // point and spot lights
std::vector<Probe> codeProbes();       // octahedral, unorm, roots, 9.9.9.e5, all layouts of the G-buffer
std::vector<Probe> positionProbes();   // positions from depth, tiles and froxels of pixels

std::vector<Probe> momentProbes();  // moment shadow maps
std::vector<Probe> airProbes();     // haze
std::vector<Probe> ltcProbes();     // polygonal lights
// Specular anti-aliasing, multiple scattering, spherical harmonics; the tone curve.
std::vector<Probe> surfaceProbes();

// All probes in the order of the table: device operations first, then functions made of them.
const std::vector<Probe>& allProbes();

}  // namespace diptych::probe
