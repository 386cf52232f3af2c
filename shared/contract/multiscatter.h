// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_MULTISCATTER_H
#define DIPTYCH_CONTRACT_MULTISCATTER_H

#include "types.h"

CONTRACT_BEGIN

// FEATURE_multiscatter: what stands for light that leaves a rough surface after more than one reflection
// between its microfacets, which the specular lobe leaves out.
CONTRACT_CONST(uint, MULTISCATTER_OFF, 0);
CONTRACT_CONST(uint, MULTISCATTER_ENERGY, 1);  // a brighter lobe: Turquin 2019
CONTRACT_CONST(uint, MULTISCATTER_FDEZ, 2);    // a Lambertian lobe beside it: Fdez-Aguera 2019

CONTRACT_END

#endif
