// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

// One workgroup lists the tiles of each class, in the image's order so that lists do not vary from run to
// run, and writes their draw and dispatches. Each thread counts the layered ones of a range of tiles, then
// the workgroup sums the ranges (Hillis and Steele 1986, "Data parallel algorithms").
#include "shaders/lib/contract.glsl"

layout(local_size_x = TILE_LIST_THREADS) in;
layout(push_constant, scalar) uniform TileBlock { TileConstants constants; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer TileDraws { TileDraw at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer TileDispatches {
    TileDispatch at[];
};

shared uint sums[TILE_LIST_THREADS];

// count: tiles of the class.
void writeCommands(const uint tile_class, const uint count, const uint tiles) {
    uint thread = gl_LocalInvocationIndex;
    if (thread == 0u) TileDraws(constants.draws).at[tile_class] = TileDraw(6u, count, 0u, 0u);
    uint dispatches = (tiles + TILES_PER_DISPATCH - 1u) / TILES_PER_DISPATCH;
    for (uint i = thread; i < dispatches; i += TILE_LIST_THREADS) {
        uint before = min(i * TILES_PER_DISPATCH, count);
        TileDispatches(constants.dispatches).at[tile_class * dispatches + i] =
            TileDispatch(LIGHTING_TILE_GROUPS, min(count - before, TILES_PER_DISPATCH), 1u);
    }
}

void main() {
    Words classes = Words(constants.classes), lists = Words(constants.lists);
    uint thread = gl_LocalInvocationIndex, tiles = constants.size.x * constants.size.y;
    uint run = (tiles + TILE_LIST_THREADS - 1u) / TILE_LIST_THREADS;
    uint first = min(thread * run, tiles), end = min(first + run, tiles);
    uint layered = 0u;
    for (uint i = first; i < end; ++i) layered += classes.at[i];
    sums[thread] = layered;
    barrier();
    for (uint step = 1u; step < TILE_LIST_THREADS; step *= 2u) {
        uint before = thread >= step ? sums[thread - step] : 0u;
        barrier();
        sums[thread] += before;
        barrier();
    }
    // The first list has layered tiles after those of the base, backwards; the second is the first one
    // backwards. So both are written completely.
    uint before = sums[thread] - layered;
    for (uint i = first; i < end; ++i) {
        uint tile_class = classes.at[i], tile = i % constants.size.x | i / constants.size.x << 16;
        uint at = tile_class == TILES_LAYERED ? tiles - 1u - before : i - before;
        lists.at[at] = tile;
        lists.at[2u * tiles - 1u - at] = tile;
        before += tile_class;
    }
    layered = sums[TILE_LIST_THREADS - 1u];
    writeCommands(TILES_BASE, tiles - layered, tiles);
    writeCommands(TILES_LAYERED, layered, tiles);
}
