// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_MULTISCATTER_H
#define DIPTYCH_CONTRACT_MULTISCATTER_H

#include "types.h"

CONTRACT_BEGIN

// FEATURE_multiscatter: model of multiple scattering between microfacets, which the specular lobe omits.
CONTRACT_CONST(uint, MULTISCATTER_OFF, 0);
CONTRACT_CONST(uint, MULTISCATTER_ENERGY, 1);  // scales the specular lobe: Turquin 2019
CONTRACT_CONST(uint, MULTISCATTER_FDEZ, 2);    // adds a Lambertian lobe: Fdez-Aguera 2019

CONTRACT_END

#endif
