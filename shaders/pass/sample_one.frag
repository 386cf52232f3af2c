// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One sample of each pixel of up to SAMPLE_IMAGES images. feature_captures: a bit for each image, and above
// them the sample.
#include "shaders/lib/contract.glsl"

layout(set = SET_GBUFFER, binding = 0) uniform texture2DMS image_0;
layout(set = SET_GBUFFER, binding = 1) uniform texture2DMS image_1;
layout(set = SET_GBUFFER, binding = 2) uniform texture2DMS image_2;
layout(set = SET_GBUFFER, binding = 3) uniform texture2DMS image_3;

layout(location = 0) out vec4 out_0;
layout(location = 1) out vec4 out_1;
layout(location = 2) out vec4 out_2;
layout(location = 3) out vec4 out_3;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    int sample_index = int(feature_captures >> SAMPLE_IMAGES);
    if (on(feature_captures & 1)) out_0 = texelFetch(image_0, p, sample_index);
    if (on(feature_captures & 2)) out_1 = texelFetch(image_1, p, sample_index);
    if (on(feature_captures & 4)) out_2 = texelFetch(image_2, p, sample_index);
    if (on(feature_captures & 8)) out_3 = texelFetch(image_3, p, sample_index);
}
