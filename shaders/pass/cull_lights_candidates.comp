// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// LIGHT_THREADS threads per light share the slices and rows of tiles that the light's bounding sphere may
// reach. They mark the light as a candidate of each slice and of each tile.
#include "shaders/lib/lights/light_culling.glsl"

layout(local_size_x = 64) in;

void main() {
    uint light = threadIndex() / LIGHT_THREADS, thread = threadIndex() % LIGHT_THREADS;
    if (light >= grid.local_lights) return;
    LightBound bound = boundOf(light);
    uint word = light / 32u, bit = 1u << (light % 32u);
    uvec2 slices = slicesOfLight(bound);
    for (uint slice = slices.x + thread; slice < slices.y; slice += LIGHT_THREADS)
        atomicOr(candidates[sliceWord(word, slice)], bit);
    uvec4 rect = rectOfLight(bound);
    for (uint row = rect.z + thread; row < rect.w; row += LIGHT_THREADS)
        for (uint column = rect.x; column < rect.y; ++column)
            atomicOr(candidates[tileWord(word, row * grid.tiles.x + column)], bit);
}
