// SPDX-License-Identifier: MIT
// Layers of which no order is known: their optical depths are added up, -ln(1 - opacity) of each.
#ifndef OPTICAL_DEPTH_GLSL
#define OPTICAL_DEPTH_GLSL

#include "shaders/lib/draw.glsl"
#include "shaders/lib/position.glsl"

float opticalDepth(float opacity, float most) {
    return opacity < 1.0 ? min(-log(1.0 - opacity), most) : most;
}

// From 0, of the view's nearest blended surface, to 1, of the farthest: linear in the logarithm of the
// distance (Muenstermann et al. 2018, section 4.2), whatever the unit of length; of an orthographic view,
// which may begin at 0, in the distance. `z`: reversed depth.
float blendedDepth(float z) {
    float nearest = constants.blended.nearest, farthest = constants.blended.farthest, distance = viewDepth(z);
    float range = on(feature_orthographic) ? farthest - nearest : log(farthest / nearest);
    float depth = on(feature_orthographic) ? distance - nearest : log(distance / nearest);
    return range > 0.0 ? clamp(depth / range, 0.0, 1.0) : 0.0;
}

#endif
