// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// A row's view and light grid replace a frame's.
#define VIEW_GLSL
#include "shaders/lib/contract.glsl"
View view;
LightGrid grid;

#include "shaders/lib/lights/light_grid.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "compare/probe/shaders/rows.glsl"

void setDepths(const uint i) {
    view.depth_numerator = vec2(in1(i), in1(i + 1));
    view.depth_denominator = vec2(in1(i + 2), in1(i + 3));
}

// four depth parameters, z; direction_0, _x, _y, origin_0, _x, _y, pixel -> position
void position() {
    setDepths(0);
    view.direction_0 = in3(5);
    view.direction_x = in3(8);
    view.direction_y = in3(11);
    view.origin_0 = in3(14);
    view.origin_x = in3(17);
    view.origin_y = in3(20);
    out3(0, positionFromDepth(vec2(in1(23), in1(24)), in1(4)));
}

// offset, shift, slices, tiles across and down, tile shift, depth, pixel -> slice, its nearest and
// farthest depth, column and row of the tile
void froxel() {
    grid.slice_offset = in1(0);
    grid.slice_shift = uint(in1(1));
    grid.slices = uint(in1(2));
    grid.tiles = uvec2(in1(3), in1(4));
    grid.tile_shift = uint(in1(5));
    uint cell = cellOf(vec2(in1(7), in1(8)), in1(6));
    uint slice = cell / (grid.tiles.x * grid.tiles.y);
    vec2 depths = sliceDepths(slice);
    out1(0, float(slice));
    out1(1, depths.x);
    out1(2, depths.y);
    out1(3, float(cell % grid.tiles.x));
    out1(4, float(cell / grid.tiles.x % grid.tiles.y));
}

void main() {
    if (beyondRows()) return;
    switch (probed) {
        case 0:
            setDepths(0);
            out1(0, viewDepth(in1(4)));
            break;
        case 1: position(); break;
        case 2: froxel(); break;
    }
}
