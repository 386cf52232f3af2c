// SPDX-License-Identifier: MIT
// The view and the light grid. lavapipe gathers every float of a uniform buffer one by one for eight
// fragments, some 27 instructions although all read the same value; a flat input takes one. So full-screen
// shaders (FLAT_VIEW) pass PACKED_VIEW through their vertex shader. Shaders of a scene's triangles fetch
// it as texels, because every flat input costs 48 more bytes a triangle there. Components are passed as
// bits, so values stay exact.
#ifndef VIEW_GLSL
#define VIEW_GLSL

#include "shaders/lib/contract.glsl"

layout(set = SET_FRAME, binding = BINDING_VIEW, scalar) uniform ViewBlock { View view_block; };
layout(set = SET_FRAME, binding = BINDING_LIGHT_GRID, scalar) uniform LightGridBlock {
    LightGrid grid_block;
};

layout(set = SET_FRAME, binding = BINDING_VIEW_TEXELS) uniform usamplerBuffer view_texels;

#ifdef FLAT_VIEW
#ifdef STAGE_vert
layout(location = 0) flat out uvec4 flat_view[PACKED_VIEW_TEXELS];
#else
layout(location = 0) flat in uvec4 flat_view[PACKED_VIEW_TEXELS];
#endif
#endif

#if defined(STAGE_frag) || defined(TEXEL_VIEW)

uvec4 viewTexel(const int i) {
#ifdef FLAT_VIEW
    if (feature_view_source == VIEW_FLAT) return flat_view[i];
#endif
    return texelFetch(view_texels, i);
}

#define UNPACK_FLOAT(texel, lane, member) v.member = uintBitsToFloat(t##texel.lane);
#define UNPACK_UINT(texel, lane, member) v.member = t##texel.lane;
#define UNPACK_SHORTS(texel, lane, low, high) v.low = t##texel.lane & 0xffffu, v.high = t##texel.lane >> 16;
#define UNPACK_BYTES(texel, lane, low, middle, high) \
    v.low = t##texel.lane & 0xffu, v.middle = t##texel.lane >> 8 & 0xffu, v.high = t##texel.lane >> 16;

View readView() {
    View v = view_block;
    if (feature_view_source != VIEW_UNIFORM && !on(feature_orthographic)) {
        uvec4 t0 = viewTexel(0), t1 = viewTexel(1), t2 = viewTexel(2), t3 = viewTexel(3), t4 = viewTexel(4);
        PACKED_VIEW(UNPACK_FLOAT, UNPACK_UINT)
    }
    return v;
}

LightGrid readGrid() {
    LightGrid v = grid_block;
    if (feature_view_source != VIEW_UNIFORM) {
        uvec4 t3 = viewTexel(3);
        PACKED_GRID(UNPACK_FLOAT, UNPACK_SHORTS, UNPACK_BYTES)
    }
    return v;
}

#undef UNPACK_FLOAT
#undef UNPACK_UINT
#undef UNPACK_SHORTS
#undef UNPACK_BYTES

View view = readView();
LightGrid grid = readGrid();

#else

View view = view_block;
LightGrid grid = grid_block;

#endif

#if defined(FLAT_VIEW) && defined(STAGE_vert)
void passViewThrough() {
    if (feature_view_source == VIEW_FLAT)
        for (int i = 0; i < PACKED_VIEW_TEXELS; ++i) flat_view[i] = texelFetch(view_texels, i);
}
#endif

#endif
