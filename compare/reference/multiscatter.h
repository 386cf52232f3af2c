// SPDX-License-Identifier: MIT
// The compensations of --multiscatter in double, from their definitions, by the integrals of the BRDF itself.
// What they approximate is in microsurface.h.
#pragma once

#include "compare/reference/brdf.h"
#include "shared/frame/setting_values.h"

namespace diptych::reference {

// energy: Turquin 2019, "Practical multiple scattering compensation for microfacet models". fdez:
// Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting". Each of a
// dielectric's layer and of a metal by themselves; a base gets what its layer, with the compensation, does
// not reflect of light from everywhere. walk: the base gets everything,
// as the walk adds what is missing and takes from the base.
Compensation compensationOf(const Surface& surface, Multiscatter multiscatter);

}  // namespace diptych::reference
