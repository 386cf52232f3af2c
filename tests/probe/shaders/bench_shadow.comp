// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

// Shadow map filters, one at a time, for tests/bench/shadow_filters.cpp: one thread a pixel, sampling
// positions slightly rotated in the map, about one texel a pixel.
#include "shaders/lib/shadows/msm.glsl"

// 0: none, 1: 5 x 5 comparisons, 2: 16 comparisons by gathers, 3: moments
layout(constant_id = 100) const uint FILTER = 0u;
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) writeonly buffer Seen { float seen[]; };
layout(set = 0, binding = 1) uniform sampler2DArrayShadow depth_map;
layout(set = 0, binding = 2) uniform sampler2DArray moment_map;
layout(push_constant, scalar) uniform Size { uvec2 size; };

float visibilityAt(const vec2 uv, const float depth, const float texel, const ShadowLight light) {
    if (FILTER == 1u) {
        float sum = 0.0;
        for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x)
                sum += texture(depth_map, vec4(uv + texel * vec2(x, y), 0.0, depth));
        return sum / 25.0;
    }
    if (FILTER == 2u) {
        vec4 sum = vec4(0.0);
        for (int y = -1; y <= 1; y += 2)
            for (int x = -1; x <= 1; x += 2)
                sum += textureGather(depth_map, vec3(uv + texel * vec2(x, y), 0.0), depth);
        return dot(sum, vec4(1.0 / 16.0));
    }
    if (FILTER == 3u)
        return visibilityOfMoments(textureLod(moment_map, vec3(uv, 0.0), 0.0), depth, light);
    return depth;
}

void main() {
    uvec2 p = gl_GlobalInvocationID.xy;
    if (p.x >= size.x) return;
    float texel = 1.0 / float(textureSize(moment_map, 0).x);
    vec2 uv = (vec2(300.5) + vec2(p.x * 0.96 - p.y * 0.28, p.x * 0.28 + p.y * 0.96)) * texel;
    ShadowLight light;
    light.exponent = 40.0;
    light.negative = 5.0;
    light.nearest = -1.0;
    light.bleed = 0.1;
    light.min_variance = 1e-8;
    light.moment_bias = 6e-5;
    seen[p.y * size.x + p.x] = visibilityAt(uv, 0.4 + 0.1 * uv.x, texel, light);
}
