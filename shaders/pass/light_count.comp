// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// A thread a list and segment: how many lights its words hold.
#include "shaders/lib/light_kernel.glsl"

layout(local_size_x = 64) in;

void main() {
    uint list = gl_GlobalInvocationID.x, segment = gl_GlobalInvocationID.y;
    if (list >= grid.lists) return;
    LightListCount count = LightListCount(0u, 0u, 0u, 0u);
    uint end = min((segment + 1u) * SEGMENT_WORDS, grid.words);
    for (uint word = segment * SEGMENT_WORDS; word < end; ++word) {
        uint mask = masks[maskWord(word, list)];
        count.all += bitCount(mask);
        count.points += bitCount(mask & bitsBelow(word, grid.point_end));
        count.points_and_spots += bitCount(mask & bitsBelow(word, grid.spot_end));
    }
    counts[list * grid.segments + segment] = count;
}
