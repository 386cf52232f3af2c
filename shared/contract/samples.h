// SPDX-License-Identifier: MIT
// Sample locations: the standard ones of Vulkan 1.3, 26.4 (Multisampling), in sixteenths of a pixel from
// its upper left corner. Devices with other locations (standardSampleLocations is false) draw one sample.
#ifndef DIPTYCH_CONTRACT_SAMPLES_H
#define DIPTYCH_CONTRACT_SAMPLES_H

#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(uint, MAX_SAMPLES, 8);
CONTRACT_CONST(uint, SAMPLE_IMAGES, 4);  // that a pass reads one sample of

// Two 4-bit coordinates per sample, x in the lower bits; the first sample is in the lowest byte.
CONTRACT_CONST(uint, SAMPLE_LOCATIONS_4, 0xeaa26e26u);
CONTRACT_CONST(uint, SAMPLE_LOCATIONS_8_LOW, 0x359db759u);
CONTRACT_CONST(uint, SAMPLE_LOCATIONS_8_HIGH, 0x1ffb71d3u);

// Order in which an alpha mask covers samples (MASK_COVERS of material.h): 4-bit sample indices, the first
// in the lowest bits. Each sample is far from those before it, so the covered region is centred in the
// pixel.
CONTRACT_CONST(uint, COVERAGE_ORDER_4, 0x2130u);
CONTRACT_CONST(uint, COVERAGE_ORDER_8, 0x10472563u);

// Values of FEATURE_sample_edges: which samples deferred lighting shades as one group.
CONTRACT_CONST(uint, EDGES_ALL, 0);       // none
CONTRACT_CONST(uint, EDGES_EXACT, 1);     // samples with the same bits in every attachment
CONTRACT_CONST(uint, EDGES_SIMILAR, 2);   // samples whose difference is not visible
CONTRACT_CONST(uint, EDGES_COVERAGE, 3);  // as EDGES_EXACT; one group if every visible triangle covers the
                                          // whole pixel

// Sample groups are stored as a depth. The mantissa stores the group of each sample
// (shaders/lib/samples/sample_groups.glsl); the exponent is GROUP_EXPONENT plus the number of groups, so the
// depth stays below 1. Group k of a pixel is shaded by a draw at the depth of exponent GROUP_EXPONENT + k +
// 1, which passes the depth test if the pixel has more than k groups.
CONTRACT_CONST(uint, GROUP_EXPONENT, 118);
CONTRACT_CONST(uint, GROUP_MANTISSA_BITS, 23);

// Bindings of SET_GBUFFER after those of blended surfaces. Secondary sample groups are listed, so that
// their pass has no empty fragments. A list texel stores the group's index above FURTHER_PIXEL_BITS bits
// each of the pixel's y and x. Rows have FURTHER_WIDTH texels. There are four storage images, the limit
// that every device supports.
// number  name  kind  contents
// clang-format off
#define SAMPLE_BINDINGS(X)                                                              \
    X(19, FURTHER_COUNT, storage_image, "R32_UINT, 1x1: number of listed groups")                         \
    X(20, FURTHER_LIST, storage_image, "R32_UINT: groups after the first of their pixel") \
    X(21, LIT_TARGET, storage_image, "RGBA32F: radiance of each pixel or sample, W/(sr m^2); of a light"  \
                                      " batch in compute the diffuse sum")                     \
    X(22, SPECULAR_TARGET, storage_image, "RGBA32F: of a light batch in compute the specular sum")
// clang-format on

SAMPLE_BINDINGS(CONTRACT_BINDING)
CONTRACT_CONST(uint, FURTHER_PIXEL_BITS, 14);
CONTRACT_CONST(uint, FURTHER_WIDTH_BITS, 12);
CONTRACT_CONST(uint, FURTHER_WIDTH, 1 << FURTHER_WIDTH_BITS);
// Draws that shade them cover at most this many rows of FURTHER_WIDTH fragments.
CONTRACT_CONST(uint, FURTHER_ROWS, 32);

CONTRACT_END

#endif
