// SPDX-License-Identifier: MIT
// Shadow bias, against acne: the plane of a receiver's triangle, which is compared with the map.
#ifndef RECEIVER_PLANE_GLSL
#define RECEIVER_PLANE_GLSL

#include "shaders/lib/shadows/shadow_light.glsl"
#include "shaders/lib/surface/surface.glsl"

// A surface as the light sees it in a cascade: its texel coordinates, its depth there, and the plane of
// its triangle. The plane is the depth bias of the comparisons (receiver plane depth bias, Isidoro 2006,
// "Shadow Mapping: GPU-based Tips and Techniques"): a surface at a grazing angle to the light does not
// shadow itself at any texel of a filter. Nothing is derived from neighbouring pixels.
//
// Texels towards which the plane rises are compared with the plane, up to MAX_PLANE_BIAS texels above the
// surface. Farther up the triangle may have ended, and another surface there would be mistaken for it.
// Texels where the plane rises more do not count, and they fade out before that. Texels towards which it
// falls remain, and no texel beside the filter is read for them.
struct ReceiverPlane {
    vec2 texel;
    float depth;
    vec2 slope;                 // of depth, per texel
    float normal_offset_depth;  // fall of the plane's depth if the surface was moved sideways
    float max_bias;             // largest rise of the plane that is compared, depth
    float cutoff_bias;          // rise of the plane at which a texel no longer counts, depth
    float cutoff_scale;         // weight of a texel per depth below `cutoff_bias`
};

const float MAX_PLANE_BIAS = 2.0;
// Smallest cosine between geometric normal and light that slopes use: a steeper plane crosses the whole
// scene within few texels.
const float MIN_SLOPE_COSINE = 1e-3;

// `max_bias`: largest rise of the plane above the surface, texels.
ReceiverPlane sunReceiverPlane(const Surface s, const ShadowLight light, const Cascade cascade,
                               const float max_bias) {
    vec2 across = vec2(dot(s.geometric_normal, light.x), dot(s.geometric_normal, light.y));
    float cosine = max(dot(s.geometric_normal, light.to_light), MIN_SLOPE_COSINE);
    float texel = 1.0 / cascade.texels_per_metre;
    float bias = cascade.bias * texel + light.rounding * lengthOf(s.position);
    vec3 position = s.position + s.geometric_normal * bias;
    float depth_of_texel = texel * light.depth_scale;
    ReceiverPlane r;
    r.texel =
        vec2(dot(position, light.x), dot(position, light.y)) * cascade.texels_per_metre + cascade.offset;
    r.depth = dot(position, light.to_light) * light.depth_scale + light.depth_offset;
    r.slope = across * (-depth_of_texel / cosine);
    r.normal_offset_depth = 0.0;
    r.max_bias = max_bias * depth_of_texel;
    r.cutoff_bias = r.max_bias;
    r.cutoff_scale = 1.0 / depth_of_texel;
    return r;
}

// 1 if the map's texel at `texel` (its centre) has nothing nearer to the light than the receiver.
float compareWithPlaneBias(const ReceiverPlane r, const float stored, const vec2 texel) {
    float bias = clamp(dot(r.slope, texel - r.texel) - r.normal_offset_depth, 0.0, r.max_bias);
    return stored > r.depth + bias ? 0.0 : 1.0;
}

// Weight of a texel, 0 to 1.
float texelWeight(const ReceiverPlane r, const vec2 texel) {
    return clamp((r.cutoff_bias - dot(r.slope, texel - r.texel)) * r.cutoff_scale, 0.0, 1.0);
}

#endif
