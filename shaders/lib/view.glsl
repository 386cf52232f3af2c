// SPDX-License-Identifier: MIT
// The view and the light grid. lavapipe gathers every float of a uniform buffer for eight fragments one by one, in some
// 27 instructions though they all read the same, and takes a flat input in one. So what shades a whole picture has them
// handed on by its vertex shader; a scene's triangles, for which each flat input is 48 bytes more to write, read the
// buffers. FLAT_VIEW is defined by shaders that may hand it on. Bits are handed on, not numbers: they come out as they went in.
#ifndef VIEW_GLSL
#define VIEW_GLSL

#include "shaders/lib/contract.glsl"

layout(set = SET_FRAME, binding = BINDING_VIEW, scalar) uniform ViewBlock { View view_block; };
layout(set = SET_FRAME, binding = BINDING_LIGHT_GRID, scalar) uniform LightGridBlock { LightGrid grid_block; };

#if defined(FLAT_VIEW) && defined(STAGE_frag)

layout(location = 0) flat in uvec4 flat_view[5];

View readView() {
    View v = view_block;
    if (feature_view_source != VIEW_FLAT) return v;
    v.direction_0 = uintBitsToFloat(flat_view[0].xyz);
    v.direction_x = uintBitsToFloat(flat_view[1].xyz);
    v.direction_y = uintBitsToFloat(flat_view[2].xyz);
    v.depth_numerator = uintBitsToFloat(uvec2(flat_view[0].w, flat_view[1].w));
    v.depth_denominator = uintBitsToFloat(uvec2(flat_view[2].w, flat_view[3].w));
    v.directional_light_count = flat_view[4].x;
    v.point_light_count = flat_view[4].y;
    v.spot_light_count = flat_view[4].z;
    return v;
}

LightGrid readGrid() {
    LightGrid g = grid_block;
    if (feature_view_source != VIEW_FLAT) return g;
    g.slice_offset = uintBitsToFloat(flat_view[3].x);
    g.slice_shift = flat_view[3].y & 0xffffu;
    g.tile_shift = flat_view[3].y >> 16;
    g.tiles = uvec2(flat_view[3].z & 0xffffu, flat_view[3].z >> 16);
    g.slices = flat_view[4].w;
    return g;
}

View view = readView();
LightGrid grid = readGrid();

#else

View view = view_block;
LightGrid grid = grid_block;

#endif

#if defined(FLAT_VIEW) && defined(STAGE_vert)

layout(location = 0) flat out uvec4 flat_view[5];

void handViewOn() {
    if (feature_view_source != VIEW_FLAT) return;
    flat_view[0] = floatBitsToUint(vec4(view.direction_0, view.depth_numerator.x));
    flat_view[1] = floatBitsToUint(vec4(view.direction_x, view.depth_numerator.y));
    flat_view[2] = floatBitsToUint(vec4(view.direction_y, view.depth_denominator.x));
    flat_view[3] = uvec4(floatBitsToUint(grid.slice_offset), grid.slice_shift | (grid.tile_shift << 16),
                         grid.tiles.x | (grid.tiles.y << 16), floatBitsToUint(view.depth_denominator.y));
    flat_view[4] = uvec4(view.directional_light_count, view.point_light_count, view.spot_light_count, grid.slices);
}

#endif

#endif
