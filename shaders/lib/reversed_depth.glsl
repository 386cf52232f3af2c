// SPDX-License-Identifier: MIT
// From the depth that the scene's depth image holds, or that a fragment has after the viewport, to the
// reversed depth that everything computes with: 1 at the near plane, 0 at the far end and where nothing was
// drawn.
#ifndef REVERSED_DEPTH_GLSL
#define REVERSED_DEPTH_GLSL

#include "shaders/lib/contract.glsl"

// In steps the viewport maps the far end to the first one, so that 0 is left to what nothing was drawn to. A
// surface within half a step of the far end is taken to be at a quarter of one: with no far plane its distance
// would be infinite.
float reversedDepth(float stored) {
    if (feature_depth_format == DEPTH_STANDARD) return 1.0 - stored;
    if (feature_depth_format == DEPTH_REVERSED) return stored;
    float first = feature_depth_format == DEPTH_STEPS_16 ? 1.0 / 65535.0 : 1.0 / 16777215.0;
    float z = max((stored - first) / (1.0 - first), 0.25 * first);
    return stored > 0.0 ? z : 0.0;
}

#endif
