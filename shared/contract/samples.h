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

// Groups of samples that are shaded as one are stored as a depth: which sample is in which group in the
// mantissa (shaders/lib/sample_groups.glsl), in the exponent GROUP_EXPONENT and their number, of at most
// MAX_SAMPLES, which leaves it below 1. A draw at the depth of one group more passes the test where there
// are as many: group k of a pixel is shaded by the draw at the depth of exponent GROUP_EXPONENT + k + 1.
CONTRACT_CONST(uint, GROUP_EXPONENT, 118);
CONTRACT_CONST(uint, GROUP_MANTISSA_BITS, 23);

// Bindings of SET_GBUFFER after those of blended surfaces. Groups after a pixel's first one stand in a list,
// so that what shades them has no fragments beside them: each in a texel, its number above twice
// FURTHER_PIXEL_BITS bits of its pixel's y and x, in rows of FURTHER_WIDTH. Four storage images are what
// every device has.
// number  name  kind  what it holds
// clang-format off
#define SAMPLE_BINDINGS(X)                                                              \
    X(14, FURTHER_COUNT, storage_image, "R32_UINT, 1x1: number of listed groups")                         \
    X(15, FURTHER_LIST, storage_image, "R32_UINT: groups after the first of their pixel") \
    X(16, LIT_TARGET, storage_image, "RGBA32F: radiance of each pixel or sample, W/(sr m^2); of a light"  \
                                      " batch in compute the diffuse sum")                     \
    X(17, SPECULAR_TARGET, storage_image, "RGBA32F: of a light batch in compute the specular sum")
// clang-format on

#define DIPTYCH_BINDING_NUMBER(number, name, kind, what) CONTRACT_CONST(uint, BINDING_##name, number);
SAMPLE_BINDINGS(DIPTYCH_BINDING_NUMBER)
#undef DIPTYCH_BINDING_NUMBER
CONTRACT_CONST(uint, FURTHER_PIXEL_BITS, 14);
CONTRACT_CONST(uint, FURTHER_WIDTH_BITS, 12);
CONTRACT_CONST(uint, FURTHER_WIDTH, 1 << FURTHER_WIDTH_BITS);
// They are shaded by draws of a fragment each, FURTHER_WIDTH wide and of so many rows at most.
CONTRACT_CONST(uint, FURTHER_ROWS, 32);

// Side of the square of pixels that a workgroup of deferred lighting shades: it lies in one tile of light
// lists, whose side is as long or a multiple of it.
CONTRACT_CONST(uint, LIGHTING_GROUP, 8);

CONTRACT_END

#endif
