// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/lights/light_overlap.glsl"
#include "shaders/lib/lights/light_rect.glsl"
#include "tests/probe/shaders/probe.glsl"

// inputs of light_rect.comp, and a row (13) -> its columns (2)
void main() {
    if (PROBE_ROW >= probe_rows) return;
    TileSize size = TileSize(vec2(IN(13, 6), IN(13, 7)), IN(13, 8), IN(13, 9));
    vec2 slab = vec2(IN(13, 4), IN(13, 5)), edges = vec2(IN(13, 12), IN(13, 12) + 1.0) * size.side;
    CellBounds row = CellBounds(vec2(0.0), (edges - size.centre.y) * size.pixel, slab);
    float squared = squaredDistanceToRow(IN3(13, 0), row);
    uvec2 columns = columnsOfSphere(IN3(13, 0), IN(13, 3), slab, squared, size, uint(IN(13, 10)));
    for (uint i = 0; i < 2; ++i) OUT(2, i) = float(columns[i]);
}
