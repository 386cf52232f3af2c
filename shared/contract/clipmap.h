// SPDX-License-Identifier: MIT
// The clipmap of the sun's shadow: levels of pages around the camera, each level's texels twice as wide as
// those of the one before, and a last level of one page that covers the whole scene. Which pages there are is
// chosen from what a picture shows; a page that is not there is served by a coarser level.
#ifndef DIPTYCH_CONTRACT_CLIPMAP_H
#define DIPTYCH_CONTRACT_CLIPMAP_H

#include "types.h"

CONTRACT_BEGIN

// What all levels share. Behind it come a Cascade for each level, the whole scene's the last, whose texels
// are counted from the lower corner of the level's window; then a ClipmapPage for each page of each window,
// level by level and row by row, and one for the whole scene.
struct Clipmap {
    vec3 centre;  // of all windows, world axes, camera as origin, m
    float
        levels_from;  // 1/m: one over the distance up to which level 0 serves; each next serves twice as far
    uint levels;      // that have a window: the number of the whole scene's
    uint width;       // pages of a window's side
    float page;       // texels of a page's side
    float spare;
};
#define CLIPMAP_OF_TEXELS(a, b) Clipmap(a.xyz, a.w, floatBitsToUint(b.x), floatBitsToUint(b.y), b.z, b.w)
CONTRACT_LANE(Clipmap, centre, 0, 0);
CONTRACT_LANE(Clipmap, levels, 1, 0);
CONTRACT_LANE(Clipmap, page, 1, 2);
CONTRACT_TEXELS(Clipmap, 2);
CONTRACT_CONST(uint, CLIPMAP_TEXELS, 2);

// Where a page is read: its own texels, or those of a coarser level that covers it.
struct ClipmapPage {
    vec2 shift;   // texels: from the serving level's coordinates to the atlas
    float level;  // that serves
    float spare;
};
#define CLIPMAP_PAGE_OF_TEXEL(a) ClipmapPage(a.xy, a.z, a.w)
CONTRACT_LANE(ClipmapPage, shift, 0, 0);
CONTRACT_LANE(ClipmapPage, level, 0, 2);
CONTRACT_TEXELS(ClipmapPage, 1);

CONTRACT_CONST(uint, CLIPMAP_MARK_SIDE, 8);  // threads of a workgroup's side, a pixel each
CONTRACT_CONST(uint, SET_CLIPMAP, 1);        // of the kernel that marks pages, beside SET_FRAME

CONTRACT_END

// clang-format off
#define CLIPMAP_BINDINGS(X)                                                     \
    X(0, CLIPMAP_DEPTH, image,          "the picture's reversed depth")         \
    X(1, CLIPMAP_MARKS, storage_buffer, "uint[]: a bit for each ClipmapPage")
// clang-format on

CONTRACT_BEGIN
#define DIPTYCH_BINDING_NUMBER(number, name, kind, what) CONTRACT_CONST(uint, BINDING_##name, number);
CLIPMAP_BINDINGS(DIPTYCH_BINDING_NUMBER)
#undef DIPTYCH_BINDING_NUMBER
CONTRACT_END

#endif
