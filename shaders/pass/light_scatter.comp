// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// SCATTER_THREADS threads for each light: they divide among them the rows of tiles that the light's bounding
// sphere covers in each slice, and mark those tiles of a row that the light reaches.
#include "shaders/lib/light_kernel.glsl"
#include "shaders/lib/light_rect.glsl"

layout(local_size_x = 64) in;

// First and one past the last slice that the bounding sphere reaches, with one more on either side, because
// slices overlap by what rounding may move.
uvec2 slicesOfSphere(LightBound bound) {
    float near = bound.centre.z - bound.radius, far = bound.centre.z + bound.radius;
    if (far < 0.0) return uvec2(0u);
    if (feature_light_lists == LISTS_TILED) return uvec2(0u, 1u);
    return uvec2(max(sliceOf(near), 1u) - 1u, min(sliceOf(far) + 2u, grid.slices));
}

void main() {
    uint number_of_thread =
        gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
    uint light = number_of_thread / SCATTER_THREADS, thread = number_of_thread % SCATTER_THREADS;
    if (light >= grid.local_lights) return;
    LightBound bound = light_bounds[light];
    bool tiled = feature_light_lists == LISTS_TILED;
    const vec2 all_depths = vec2(0.0, MAX_BOUND_RADIUS);
    TileSize size = TileSize(grid.centre, grid.pixel, float(1u << grid.tile_shift));
    uvec2 slices = slicesOfSphere(bound),
          rows = tilesOfSphere(bound.centre, bound.radius, all_depths, size, grid.tiles).zw;
    uint height = max(rows.y, rows.x) - rows.x;
    uint word = light / 32u, bit = 1u << (light % 32u);
    for (uint i = thread; i < (slices.y - slices.x) * height; i += SCATTER_THREADS) {
        uint slice = slices.x + i / height, row = rows.x + i % height;
        vec2 slab = tiled ? all_depths : sliceDepths(slice);
        float squared = squaredDistanceToRow(bound.centre, cellBounds(uvec2(0u, row), slab));
        uvec2 columns = columnsOfSphere(bound.centre, bound.radius, slab, squared, size, grid.tiles.x);
        for (uint column = columns.x; column < columns.y; ++column) {
            uint number = row * grid.tiles.x + column;
            uvec2 tile = uvec2(column, row);
            bool reached = reaches(bound, cellBounds(tile, tiled ? cellDepths(number, slice) : slab));
            if (reached) atomicOr(masks[maskWord(word, slice * grid.tiles.x * grid.tiles.y + number)], bit);
        }
    }
}
