// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/lights/light_rect.glsl"
#include "tests/probe/shaders/probe.glsl"

// sphere's centre and radius, the slab's two depths, the grid's centre, pixel size, tile side and tile
// counts (12) -> columns, rows (4)
void main() {
    if (PROBE_ROW >= probe_rows) return;
    TileSize size = TileSize(vec2(IN(12, 6), IN(12, 7)), IN(12, 8), IN(12, 9));
    uvec4 rect =
        tilesOfSphere(IN3(12, 0), IN(12, 3), vec2(IN(12, 4), IN(12, 5)), size, uvec2(IN(12, 10), IN(12, 11)));
    for (uint i = 0; i < 4; ++i) OUT(4, i) = float(rect[i]);
}
