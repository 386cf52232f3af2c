// SPDX-License-Identifier: MIT
// The tiles that a light's ball may reach, as a rectangle and row by row: what the scatter kernel walks instead of all.
#ifndef LIGHT_RECT_GLSL
#define LIGHT_RECT_GLSL

#include "shaders/lib/contract.glsl"

// Of a LightGrid, what tiles are: see there.
struct TileSize {
    vec2 centre;  // pixel coordinates of the optical axis
    float pixel;  // side of a pixel in m per m of depth; orthographic: in m
    float side;   // of a tile, pixels
};

// Tiles that the interval [low, high] (m, at depths z) covers along one axis: first and one past the last.
uvec2 tilesCovered(float low, float high, vec2 z, float centre, TileSize size, uint tiles) {
    vec2 side = on(feature_orthographic) ? vec2(low, high)
                                         : vec2(low / (low < 0.0 ? z.x : z.y), high / (high < 0.0 ? z.y : z.x));
    // A hundredth of a pixel for rounding; pixels' centres are half a pixel from an edge.
    vec2 tile = (side / size.pixel + centre + vec2(-0.01, 0.01)) / size.side;
    vec2 bounded = clamp(vec2(floor(tile.x), floor(tile.y) + 1.0), 0.0, float(tiles));
    return uvec2(bounded);
}

// View depths of what the slab leaves of the ball, m, above 0; of nothing the first is the larger one.
vec2 depthsOfBall(vec3 ball, float radius, vec2 slab) {
    return vec2(max(max(slab.x, ball.z - radius), 1e-30), min(slab.y, ball.z + radius));
}

// Columns [x, y) and rows [z, w) of tiles that a ball (view axes, m) may reach between the view depths `slab`; of none,
// y <= x or w <= z. By the box around what the slab leaves of the ball: never too small, and exact for no light.
uvec4 tilesOfBall(vec3 ball, float radius, vec2 slab, TileSize size, uvec2 tiles) {
    vec2 depths = depthsOfBall(ball, radius, slab);
    float beyond = max(max(slab.x - ball.z, ball.z - slab.y), 0.0);
    float cut = sqrt(max(radius * radius - beyond * beyond, 0.0));
    vec2 z = vec2(depths.x, max(depths.x, depths.y));
    uvec4 found = uvec4(tilesCovered(ball.x - cut, ball.x + cut, z, size.centre.x, size, tiles.x),
                        tilesCovered(ball.y - cut, ball.y + cut, z, size.centre.y, size, tiles.y));
    return depths.x <= depths.y ? found : uvec4(0u);
}

// Columns [x, y) of one row of tiles that the ball may reach there; of none, y <= x. `squared`: of the distance from its
// centre to the row within the slab, at most: what is there of the ball is no farther along x than what is left.
uvec2 columnsOfBall(vec3 ball, float radius, vec2 slab, float squared, TileSize size, uint columns) {
    vec2 depths = depthsOfBall(ball, radius, slab);
    float left = radius * radius - squared, cut = sqrt(max(left, 0.0));
    vec2 z = vec2(depths.x, max(depths.x, depths.y));
    uvec2 found = tilesCovered(ball.x - cut, ball.x + cut, z, size.centre.x, size, columns);
    return left >= 0.0 && depths.x <= depths.y ? found : uvec2(0u);
}

#endif
