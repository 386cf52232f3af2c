// SPDX-License-Identifier: MIT
// The probes, group by group; each function makes its part of the table.
#pragma once

#include "compare/probe/probe.h"

namespace diptych::probe {

std::vector<Probe> operationProbes();  // what a device does
std::vector<Probe> brdfProbes();       // D, the lobe, F
std::vector<Probe> lightProbes();      // points and spots
std::vector<Probe> codeProbes();       // octahedral, unorm, roots, 9.9.9.e5, all layouts of the G-buffer
std::vector<Probe> placeProbes();      // positions from depth, cells of pixels

std::vector<Probe> momentProbes();   // of shadow maps
std::vector<Probe> airProbes();      // haze
std::vector<Probe> ltcProbes();      // polygons of light
std::vector<Probe> surfaceProbes();  // specular anti-aliasing, between microfacets, harmonics; the tone curve

// All of them, in the order of the table: what a device does, then what is made of that.
const std::vector<Probe>& allProbes();

}  // namespace diptych::probe
