// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One workgroup for each cell: its threads test one light each until all lights are done.
#include "shaders/lib/light_kernel.glsl"

layout(local_size_x = LIST_GROUP) in;

shared uint bits[LIST_GROUP / 32u];

void main() {
    uint thread = gl_LocalInvocationIndex, slice = gl_WorkGroupID.z;
    uvec2 tile = gl_WorkGroupID.xy;
    uint number = tile.y * grid.tiles.x + tile.x;
    uint cell = slice * grid.tiles.x * grid.tiles.y + number;
    CellBounds bounds = cellBounds(tile, cellDepths(number, slice));
    for (uint first = 0u; first < grid.local_lights; first += LIST_GROUP) {
        if (thread < LIST_GROUP / 32u) bits[thread] = 0u;
        barrier();
        uint light = first + thread;
        if (light < grid.local_lights && reaches(light_bounds[light], bounds))
            atomicOr(bits[thread / 32u], 1u << (thread % 32u));
        barrier();
        uint word = first / 32u + thread;
        if (thread < LIST_GROUP / 32u && word < grid.words) masks[maskWord(word, cell)] = bits[thread];
        barrier();
    }
}
