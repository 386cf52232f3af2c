// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// LIGHT_THREADS threads per light share the rows of tiles that its bounding sphere covers in each slice,
// and mark the tiles of a row that the light overlaps.
#include "shaders/lib/lights/light_culling.glsl"

layout(local_size_x = 64) in;

void main() {
    uint light = threadIndex() / LIGHT_THREADS, thread = threadIndex() % LIGHT_THREADS;
    if (light >= grid.local_lights) return;
    LightBound bound = boundOf(light);
    uvec2 slices = slicesOfLight(bound);
    uvec4 rect = rectOfLight(bound);
    uint height = rect.w - rect.z;
    uint word = light / 32u, bit = 1u << (light % 32u);
    for (uint i = thread; i < (slices.y - slices.x) * height; i += LIGHT_THREADS) {
        uint slice = slices.x + i / height, row = rect.z + i % height;
        uvec2 columns = columnsOfLight(bound, row, slabOf(slice));
        uint end = min(columns.y, rect.y);
        for (uint column = max(columns.x, rect.x); column < end; ++column) {
            uint list = (slice * grid.tiles.y + row) * grid.tiles.x + column;
            if (on(feature_lights_in_front)) {
                if (!overlapsInFront(bound, uvec2(column, row))) continue;
                atomicOr(masks[maskWord(word, listInFront(list))], bit);
            }
            if (overlapsCell(bound, uvec2(column, row), slice)) atomicOr(masks[maskWord(word, list)], bit);
        }
    }
}
