// SPDX-License-Identifier: MIT
// Where the samples of a pixel are: the standard places of Vulkan 1.3, 26.4 (Multisampling), in sixteenths of
// a pixel from its upper left corner. Devices that have others (standardSampleLocations is false) draw one
// sample.
#ifndef DIPTYCH_CONTRACT_SAMPLES_H
#define DIPTYCH_CONTRACT_SAMPLES_H

#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(uint, MAX_SAMPLES, 8);

// Two numbers of 4 bits each a sample, x in the lower; the first sample in the lowest byte.
CONTRACT_CONST(uint, SAMPLE_PLACES_4, 0xeaa26e26u);
CONTRACT_CONST(uint, SAMPLE_PLACES_8_LOW, 0x359db759u);
CONTRACT_CONST(uint, SAMPLE_PLACES_8_HIGH, 0x1ffb71d3u);

// The order in which an alpha mask covers samples (MASK_COVERS of material.h), 4 bits each, the first in the
// lowest: each next one far from those before, so that what is covered lies about the pixel's middle.
CONTRACT_CONST(uint, COVERAGE_ORDER_4, 0x2130u);
CONTRACT_CONST(uint, COVERAGE_ORDER_8, 0x10472563u);

// Values of FEATURE_sample_edges: the samples that deferred lighting shades as one.
CONTRACT_CONST(uint, EDGES_ALL, 0);       // none
CONTRACT_CONST(uint, EDGES_EXACT, 1);     // those of the same bits in every attachment
CONTRACT_CONST(uint, EDGES_SIMILAR, 2);   // those that differ by less than is seen
CONTRACT_CONST(uint, EDGES_COVERAGE, 3);  // exact, and all of a pixel that each of its triangles covers

// Groups of samples that are shaded as one are stored as a depth: their number above GROUP_CODE_BITS bits
// that say which sample is in which group (shaders/lib/sample_groups.glsl), over 2^GROUP_BITS. A draw at the
// depth of one group more passes the test where there are as many: group k of a pixel is shaded by the draw
// at (k + 1) 2^GROUP_CODE_BITS / 2^GROUP_BITS.
CONTRACT_CONST(uint, GROUP_CODE_BITS, 19);
CONTRACT_CONST(uint, GROUP_BITS, 23);

CONTRACT_END

#endif
