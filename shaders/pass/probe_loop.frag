// SPDX-License-Identifier: MIT
#version 460

layout(location = 0) out vec4 out_count;

// Number of iterations, out of 100,000, that one invocation completes.
void main() {
    uint end = 99999u + uint(gl_FragCoord.x + 0.5);
    uint state = end, count = 0u;
    for (uint i = 0u; i < end; ++i) {
        state = state * 1664525u + 1013904223u;
        if (state != 0u) ++count;
    }
    out_count = vec4(float(count));
}
