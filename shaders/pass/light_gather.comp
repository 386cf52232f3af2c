// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One workgroup for each cell: its threads test one light each until all lights are done.
#include "shaders/lib/light_kernel.glsl"

layout(local_size_x = LIST_GROUP) in;

shared uint near_bits[LIST_GROUP / 32u], far_bits[LIST_GROUP / 32u];

void main() {
    uint thread = gl_LocalInvocationIndex, slice = gl_WorkGroupID.z;
    uvec2 tile = gl_WorkGroupID.xy;
    uint number = tile.y * grid.tiles.x + tile.x;
    uint cell = slice * grid.tiles.x * grid.tiles.y + number;
    vec2 depths = cellDepths(number, slice);
    CellBounds opaque = cellBounds(tile, depths);
    bool tiled = feature_light_lists == LISTS_TILED;
    CellBounds transparent = cellBounds(tile, tiled ? transparentDepths(number) : depths);
    for (uint first = 0u; first < grid.local_lights; first += LIST_GROUP) {
        if (thread < LIST_GROUP / 32u) {
            near_bits[thread] = 0u;
            far_bits[thread] = 0u;
        }
        barrier();
        uint light = first + thread;
        if (light < grid.local_lights) {
            LightBound bound = light_bounds[light];
            bool around = !tiled || reaches(bound, transparent);
            if (around && reaches(bound, opaque)) atomicOr(near_bits[thread / 32u], 1u << (thread % 32u));
            if (tiled && around) atomicOr(far_bits[thread / 32u], 1u << (thread % 32u));
        }
        barrier();
        uint word = first / 32u + thread;
        if (thread < LIST_GROUP / 32u && word < grid.words) {
            masks[maskWord(word, cell)] = near_bits[thread];
            if (tiled) masks[maskWord(word, grid.cells + cell)] = far_bits[thread];
        }
        barrier();
    }
}
