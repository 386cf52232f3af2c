// SPDX-License-Identifier: MIT
// The rectangle of tiles that a light's ball may reach: what the scatter kernel walks instead of all of them.
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

// Columns [x, y) and rows [z, w) of tiles that a ball (view axes, m) may reach between the view depths `slab`; of none,
// y <= x or w <= z. By the box around what the slab leaves of the ball: never too small, and exact for no light.
uvec4 tilesOfBall(vec3 ball, float radius, vec2 slab, TileSize size, uvec2 tiles) {
    float near = max(max(slab.x, ball.z - radius), 1e-30);
    float far = min(slab.y, ball.z + radius);
    float beyond = max(max(slab.x - ball.z, ball.z - slab.y), 0.0);
    float cut = sqrt(max(radius * radius - beyond * beyond, 0.0));
    vec2 z = vec2(near, max(near, far));
    uvec4 found = uvec4(tilesCovered(ball.x - cut, ball.x + cut, z, size.centre.x, size, tiles.x),
                        tilesCovered(ball.y - cut, ball.y + cut, z, size.centre.y, size, tiles.y));
    return near <= far ? found : uvec4(0u);
}

#endif
