// SPDX-License-Identifier: MIT
// The compensations of --multiscatter in double, from their definitions, by integrals of the BRDF.
// microsurface.h has the ground truth.
#pragma once

#include "compare/reference/scattering/brdf.h"
#include "shared/frame/setting_values.h"

namespace diptych::reference {

// energy: Turquin 2019, "Practical multiple scattering compensation for microfacet models". fdez:
// Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting". A
// dielectric's layer and a metal are compensated separately. With BaseLayer::max, the base receives the
// uniform light that the compensated layer does not reflect. walk: the base receives all light; the random
// walk adds and subtracts the rest.
Compensation compensationOf(const Surface& surface, Multiscatter multiscatter);

}  // namespace diptych::reference
