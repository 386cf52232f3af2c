// SPDX-License-Identifier: MIT
// Percentage-closer filtering.
#ifndef PCF_GLSL
#define PCF_GLSL

#include "shaders/lib/shadows/receiver_plane.glsl"

// Box filter of feature_shadow_kernel texels around the receiver, each weighted by its area in the box
// (percentage-closer filtering, Reeves et al. 1987, "Rendering Antialiased Shadows with Depth Maps").
// `shift`: from the receiver's texels to the layer's, whole.
float pcfVisibility(const sampler2DArray map, const ReceiverPlane r, const vec2 shift, const uint layer) {
    vec2 size = vec2(textureSize(map, 0).xy);
    vec2 low = r.texel - 0.5 * float(feature_shadow_kernel);
    vec2 first = floor(low), part = low - first;
    // The box's area is summed in the same order as its lit part, so that full light is exactly 1 and
    // shadow 0.
    float lit = 0.0, area = 0.0;
    for (uint y = 0; y <= feature_shadow_kernel; y += 2) {
        for (uint x = 0; x <= feature_shadow_kernel; x += 2) {
            vec2 corner = first + vec2(x, y);  // of 2 x 2 texels
            vec4 stored = textureGather(map, vec3((corner + shift + 1.0) / size, float(layer)));
            vec2 wx = vec2(x == 0u ? 1.0 - part.x : 1.0, x + 1u == feature_shadow_kernel ? part.x : 1.0);
            vec2 wy = vec2(y == 0u ? 1.0 - part.y : 1.0, y + 1u == feature_shadow_kernel ? part.y : 1.0);
            vec4 weights =
                vec4(wx.x * wy.y, wx.y * wy.y, wx.y * wy.x, wx.x * wy.x);  // in textureGather's order
            weights.x *= texelWeight(r, corner + vec2(0.5, 1.5));
            weights.y *= texelWeight(r, corner + vec2(1.5, 1.5));
            weights.z *= texelWeight(r, corner + vec2(1.5, 0.5));
            weights.w *= texelWeight(r, corner + vec2(0.5, 0.5));
            lit += weights.x * compareWithPlaneBias(r, stored.x, corner + vec2(0.5, 1.5));
            lit += weights.y * compareWithPlaneBias(r, stored.y, corner + vec2(1.5, 1.5));
            lit += weights.z * compareWithPlaneBias(r, stored.z, corner + vec2(1.5, 0.5));
            lit += weights.w * compareWithPlaneBias(r, stored.w, corner + vec2(0.5, 0.5));
            area += weights.x;
            area += weights.y;
            area += weights.z;
            area += weights.w;
        }
    }
    return area > 0.0 ? lit / area : 1.0;
}

#endif
