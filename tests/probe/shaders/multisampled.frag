// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// A fragment's coverage mask, and value and depth interpolated at the centroid of its covered samples.
layout(push_constant, scalar) uniform Constants { vec4 corners[3]; vec3 values; uint kept; };
layout(location = 0) in float v_value;
layout(location = 0) out uvec4 result;

void main() {
    const vec2 at[4] = vec2[](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));
    uint mask = uint(gl_SampleMaskIn[0]);
    vec2 sum = vec2(0.0);
    for (uint i = 0; i < 4; ++i)
        if ((mask >> i & 1u) != 0u) sum += at[i];
    vec2 offset = sum / max(float(bitCount(mask)), 1.0) - 0.5;
    // gl_FragCoord is at the pixel's centre, or at the sample with per-sample shading.
    vec2 from = offset + 0.5 - fract(gl_FragCoord.xy);
    float z = gl_FragCoord.z + from.x * dFdxFine(gl_FragCoord.z) + from.y * dFdyFine(gl_FragCoord.z);
    result = uvec4(mask, floatBitsToUint(interpolateAtOffset(v_value, offset)), floatBitsToUint(z),
                   floatBitsToUint(gl_FragCoord.x));
    gl_SampleMask[0] = int(kept);
}
