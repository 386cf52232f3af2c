// SPDX-License-Identifier: MIT
// Layers in unknown order: their optical depths, -ln(1 - opacity), are summed.
#ifndef OPTICAL_DEPTH_GLSL
#define OPTICAL_DEPTH_GLSL

#include "shaders/lib/geometry/draw.glsl"
#include "shaders/lib/geometry/position.glsl"

float opticalDepth(const float opacity, const float largest) {
    return opacity < 1.0 ? min(-log(1.0 - opacity), largest) : largest;
}

// 0 at the view's nearest blended surface, 1 at the farthest. Linear in the logarithm of the distance
// (Muenstermann et al. 2018, section 4.2), whatever the unit of length. An orthographic view, which may
// begin at 0, is linear in the distance. `z`: reversed depth.
float blendedDepth(const float z) {
    float nearest = constants.blended.nearest, farthest = constants.blended.farthest, distance = viewDepth(z);
    float range = on(feature_orthographic) ? farthest - nearest : log(farthest / nearest);
    float depth = on(feature_orthographic) ? distance - nearest : log(distance / nearest);
    return range > 0.0 ? clamp(depth / range, 0.0, 1.0) : 0.0;
}

#endif
