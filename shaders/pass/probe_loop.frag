// SPDX-License-Identifier: MIT
#version 460

layout(location = 0) out vec4 out_count;

// How many of 100,000 iterations one invocation is granted.
void main() {
    uint end = 99999u + uint(gl_FragCoord.x + 0.5);
    uint state = end, count = 0u;
    for (uint i = 0u; i < end; ++i) {
        state = state * 1664525u + 1013904223u;
        if (state != 0u) ++count;
    }
    out_count = vec4(float(count));
}
