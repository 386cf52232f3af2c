// SPDX-License-Identifier: MIT
// Converts the scene's stored depth, or a fragment's depth after the viewport, to the reversed depth that
// all code uses: 1 at the near plane, 0 at the far end and in the background.
#ifndef REVERSED_DEPTH_GLSL
#define REVERSED_DEPTH_GLSL

#include "shaders/lib/contract.glsl"

// The viewport maps the far end to the first step above the clear value, which is reserved for the
// background. For standard depth it is 2^-22, because a rasteriser's rounding near 1 must not reach 1. A
// surface nearer to the far end than half a step is placed at a quarter of one: without a far plane its
// distance would be infinite.
float reversedDepth(const float stored) {
    if (feature_depth_format == DEPTH_REVERSED) return stored;
    bool standard = feature_depth_format == DEPTH_STANDARD;
    float first = feature_depth_format == DEPTH_STEPS_16 ? 1.0 / 65535.0 : 1.0 / 16777215.0;
    float quarter = 0.25 * first;
    first = standard ? STANDARD_DEPTH_FIRST : first;
    float above = standard ? 1.0 - stored : stored;
    float z = max((above - first) / (1.0 - first), quarter);
    return above > 0.0 ? z : 0.0;
}

#endif
