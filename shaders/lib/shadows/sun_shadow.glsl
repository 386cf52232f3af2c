// SPDX-License-Identifier: MIT
// Visibility of the directional light (shared/contract/shadow.h), by the filter of --shadows.
#ifndef SUN_SHADOW_GLSL
#define SUN_SHADOW_GLSL

#include "shaders/lib/shadows/clipmap.glsl"
#include "shaders/lib/math/loop.glsl"
#include "shaders/lib/shadows/msm.glsl"
#include "shaders/lib/shadows/pcf.glsl"

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
