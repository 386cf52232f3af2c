// SPDX-License-Identifier: MIT
// Clipmap of the sun's shadow: levels of pages around the camera. Texels double in width from level to
// level. The last level is one page that covers the whole scene. Only pages that visible receivers need
// are resident; a coarser level serves the others.
#ifndef DIPTYCH_CONTRACT_CLIPMAP_H
#define DIPTYCH_CONTRACT_CLIPMAP_H

#include "types.h"

CONTRACT_BEGIN

// Shared by all levels. After it in the buffer:
//  - a Cascade per level, the whole scene's last; its texel coordinates start at the lower corner of the
//  level's window
//  - a ClipmapPage per page of each window, level by level and row by row
//  - the ClipmapPage of the whole scene
struct Clipmap {
    vec3 centre;        // of all windows; world axes from the camera, m
    float levels_from;  // 1/m: inverse distance up to which level 0 is requested; each further level reaches
                        // twice as far
    uint levels;        // number of levels with a window; also the index of the whole scene's level
    uint width;         // pages along a side of a window
    float page;         // texels along a side of a page
    float spare;
};
#define CLIPMAP_OF_TEXELS(a, b) Clipmap(a.xyz, a.w, floatBitsToUint(b.x), floatBitsToUint(b.y), b.z, b.w)
CONTRACT_LANE(Clipmap, centre, 0, 0);
CONTRACT_LANE(Clipmap, levels, 1, 0);
CONTRACT_LANE(Clipmap, page, 1, 2);
CONTRACT_TEXELS(Clipmap, 2);
CONTRACT_CONST(uint, CLIPMAP_TEXELS, 2);

// Where to read a page: its own texels, or those of a coarser level that covers it.
struct ClipmapPage {
    vec2 shift;   // texels: from coordinates of the resident level to the atlas
    float level;  // resident level
    float spare;
};
#define CLIPMAP_PAGE_OF_TEXEL(a) ClipmapPage(a.xy, a.z, a.w)
CONTRACT_LANE(ClipmapPage, shift, 0, 0);
CONTRACT_LANE(ClipmapPage, level, 0, 2);
CONTRACT_TEXELS(ClipmapPage, 1);

CONTRACT_CONST(uint, CLIPMAP_MARK_SIDE, 8);  // workgroup is SIDE x SIDE threads, one per pixel
CONTRACT_CONST(uint, SET_CLIPMAP, 1);        // of the compute shader that marks pages; it also reads
                                             // SET_FRAME

CONTRACT_END

// clang-format off
#define CLIPMAP_BINDINGS(X)                                                     \
    X(0, CLIPMAP_DEPTH, image,          "the picture's reversed depth")         \
    X(1, CLIPMAP_MARKS, storage_buffer, "uint[]: a bit for each ClipmapPage")
// clang-format on

CONTRACT_BEGIN
CLIPMAP_BINDINGS(CONTRACT_BINDING)
CONTRACT_END

#endif
