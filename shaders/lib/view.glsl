// SPDX-License-Identifier: MIT
// The view and the light grid. lavapipe gathers every float of a uniform buffer for eight fragments one by one, in some
// 27 instructions though they all read the same, and takes a flat input in one. So what shades a whole picture has them
// handed on by its vertex shader (FLAT_VIEW); a scene's triangles, for which each flat input is 48 bytes more to write,
// fetch texels. Bits are handed on, not numbers: they come out as they went in.
#ifndef VIEW_GLSL
#define VIEW_GLSL

#include "shaders/lib/contract.glsl"

layout(set = SET_FRAME, binding = BINDING_VIEW, scalar) uniform ViewBlock { View view_block; };
layout(set = SET_FRAME, binding = BINDING_LIGHT_GRID, scalar) uniform LightGridBlock { LightGrid grid_block; };

layout(set = SET_FRAME, binding = BINDING_VIEW_TEXELS) uniform usamplerBuffer view_texels;

#ifdef FLAT_VIEW
#ifdef STAGE_vert
layout(location = 0) flat out uvec4 flat_view[5];
#else
layout(location = 0) flat in uvec4 flat_view[5];
#endif
#endif

#ifdef STAGE_frag

// Texel i of PackedView.
uvec4 packedView(int i) {
#ifdef FLAT_VIEW
    if (feature_view_source == VIEW_FLAT) return flat_view[i];
#endif
    return texelFetch(view_texels, i);
}

View readView() {
    View v = view_block;
    if (feature_view_source == VIEW_UNIFORM || on(feature_orthographic)) return v;
    uvec4 a = packedView(0), b = packedView(1), c = packedView(2), d = packedView(3), e = packedView(4);
    v.direction_0 = uintBitsToFloat(a.xyz);
    v.direction_x = uintBitsToFloat(b.xyz);
    v.direction_y = uintBitsToFloat(c.xyz);
    v.depth_numerator = uintBitsToFloat(uvec2(a.w, b.w));
    v.depth_denominator = uintBitsToFloat(uvec2(c.w, d.x));
    v.directional_light_count = e.y;
    v.point_light_count = e.z;
    v.spot_light_count = e.w;
    return v;
}

LightGrid readGrid() {
    LightGrid g = grid_block;
    if (feature_view_source == VIEW_UNIFORM) return g;
    uvec4 d = packedView(3);
    g.slice_offset = uintBitsToFloat(d.y);
    g.slice_shift = d.z & 0xffffu;
    g.tile_shift = d.z >> 16;
    g.tiles = uvec2(d.w & 0xffffu, d.w >> 16);
    g.slices = packedView(4).x;
    return g;
}

View view = readView();
LightGrid grid = readGrid();

#else

View view = view_block;
LightGrid grid = grid_block;

#endif

#if defined(FLAT_VIEW) && defined(STAGE_vert)
void handViewOn() {
    if (feature_view_source == VIEW_FLAT)
        for (int i = 0; i < 5; ++i) flat_view[i] = texelFetch(view_texels, i);
}
#endif

#endif
