// SPDX-License-Identifier: MIT
// Visibility of the directional light (shared/contract/shadow.h).
#ifndef SUN_SHADOW_GLSL
#define SUN_SHADOW_GLSL

#include "shaders/lib/shadows/clipmap.glsl"
#include "shaders/lib/math/loop.glsl"
#include "shaders/lib/shadows/msm.glsl"
#include "shaders/lib/shadows/shadow_light.glsl"
#include "shaders/lib/surface/surface.glsl"

layout(set = SET_FRAME, binding = BINDING_SHADOW_MAP) uniform sampler2DArray shadow_map;

Cascade cascadeAt(const uint i) {
    vec4 a = texelFetch(shadow_texels, int(SHADOW_LIGHT_TEXELS + i));
    return CASCADE_OF_TEXEL(a);
}

// First cascade that covers a view depth, m; feature_shadow_cascades if none does.
uint cascadeOf(const ShadowLight light, const float depth) {
    uint i = 0;
    for (uint k = 0; k < feature_shadow_cascades; ++k) i += depth > light.ends[k] ? 1 : 0;
    return i;
}

// Index of that cascade, or the requested level of the clipmap, as a channel; -1 if none covers the
// position.
float cascadeIndex(const vec3 position) {
    if (!on(feature_shadows)) return -1.0;
    if (feature_shadows == SHADOWS_CLIPMAP) return float(levelAt(clipmap(), position));
    ShadowLight light = shadowLight();
    uint i = cascadeOf(light, dot(position, light.forward));
    return i < feature_shadow_cascades ? float(i) : -1.0;
}

// Resident level minus requested level of the clipmap, as a channel; -1 without a clipmap.
float pageResidency(const vec3 position) {
    if (feature_shadows != SHADOWS_CLIPMAP) return -1.0;
    return residentPage(shadowLight(), position).level - cascadeIndex(position);
}

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

// The plane that is compared with the map, against shadow acne. `max_bias`: largest rise of the
// plane above the surface, texels.
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

// One sample of blurred moments.
float momentMapVisibility(const ReceiverPlane r, const uint layer, const ShadowLight light) {
    float size = float(textureSize(shadow_map, 0).x);
    vec4 moments = textureLod(shadow_map, vec3(r.texel / size, float(layer)), 0.0);
    return visibilityOfMoments(moments, r.depth, light);
}

#include "shaders/lib/shadows/pcss.glsl"

float cascadeVisibility(const Surface s, const ShadowLight light, const uint layer) {
    Cascade cascade = cascadeAt(layer);
    ReceiverPlane r = sunReceiverPlane(s, light, cascade, MAX_PLANE_BIAS);
    if (feature_shadows == SHADOWS_PCF) return pcfVisibility(shadow_map, r, vec2(0.0), layer);
    if (feature_shadows == SHADOWS_PCSS) return pcssVisibility(s, light, cascade, r, layer);
    return momentMapVisibility(r, layer, light);
}

float clipmapVisibility(const Surface s, const ShadowLight light) {
    ClipmapPage page = residentPage(light, s.position);
    Cascade level = clipmapLevel(uint(page.level));
    ReceiverPlane r = sunReceiverPlane(s, light, level, MAX_PLANE_BIAS);
    return pcfVisibility(shadow_map, r, page.shift, 0);
}

// `faces`: whether the triangle faces the light. If none of several adjacent pixels does, they read
// nothing: a loop that no lane enters is skipped, while both sides of a branch run.
float cascadedVisibility(const Surface s, const ShadowLight light, const bool faces) {
    float depth = dot(s.position, light.forward);
    uint first = cascadeOf(light, depth);
    float fade = light.fades[min(first, MAX_CASCADES - 1u)], end = light.ends[min(first, MAX_CASCADES - 1u)];
    bool blends = depth > fade && first + 1u < feature_shadow_cascades;
    float next = blends ? (depth - fade) / (end - fade) : 0.0;
    float visibility = first < feature_shadow_cascades ? 0.0 : 1.0;
    uvec2 range = uvec2(first, faces ? min(first + (blends ? 2u : 1u), feature_shadow_cascades) : first);
    float weight = 1.0 - next;
    EACH(range) {
        visibility += weight * cascadeVisibility(s, light, range.x);
        weight = next;
        NEXT(range);
    }
    return visibility;
}

// The side of a surface with diffuse transmission that faces the light.
Surface facingLight(Surface s, const vec3 to_light) {
    bool behind = dot(s.geometric_normal, to_light) < 0.0 && dot(s.normal, to_light) < 0.0;
    if (s.diffuse_transmission > 0.0 && behind) s.geometric_normal = -s.geometric_normal;
    return s;
}

// Visibility of the shadow-casting light, 0 to 1; 0 if the triangle faces away.
float sunVisibility(Surface s) {
    if (!on(feature_shadows)) return 1.0;
    ShadowLight light = shadowLight();
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) s = facingLight(s, light.to_light);
    bool faces = dot(s.geometric_normal, light.to_light) > 0.0;
    float visibility = 0.0;
    if (feature_shadows == SHADOWS_CLIPMAP) {
        uvec2 once = uvec2(0, faces ? 1 : 0);
        EACH(once) {
            visibility = clipmapVisibility(s, light);
            NEXT(once);
        }
    } else {
        visibility = cascadedVisibility(s, light, faces);
    }
    return faces ? visibility : 0.0;
}

#endif
