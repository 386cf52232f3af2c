// SPDX-License-Identifier: MIT
// Tiles that a light's bounding sphere may overlap, as a rectangle and row by row. Light culling tests
// only those.
#ifndef LIGHT_RECT_GLSL
#define LIGHT_RECT_GLSL

#include "shaders/lib/contract.glsl"

// The members of LightGrid that define the tiles.
struct TileSize {
    vec2 centre;  // pixel coordinates of the optical axis
    float pixel;  // side of a pixel in m per m of depth; orthographic: in m
    float side;   // side of a tile, pixels
};

// Tiles that the interval [low, high] (m, at depths z) overlaps along one axis: first and one past the
// last.
uvec2 tilesCovered(const float low, const float high, const vec2 z, const float centre, const TileSize size,
                   const uint tiles) {
    vec2 side = on(feature_orthographic)
                    ? vec2(low, high)
                    : vec2(low / (low < 0.0 ? z.x : z.y), high / (high < 0.0 ? z.y : z.x));
    // The slack of 0.01 pixels is for rounding; pixel centres are half a pixel from a tile's edge.
    vec2 tile = (side / size.pixel + centre + vec2(-0.01, 0.01)) / size.side;
    vec2 bounded = clamp(vec2(floor(tile.x), floor(tile.y) + 1.0), 0.0, float(tiles));
    return uvec2(bounded);
}

// View depths of the sphere's part inside the slab, m, above 0; empty if x > y.
vec2 depthsOfSphere(const vec3 sphere, const float radius, const vec2 slab) {
    return vec2(max(max(slab.x, sphere.z - radius), 1e-30), min(slab.y, sphere.z + radius));
}

// Columns [x, y) and rows [z, w) of tiles that a sphere (centre in view axes and radius, m) may overlap
// between the view depths `slab`; empty if y <= x or w <= z. Conservative: uses the bounding box of the
// sphere's part in the slab, which is too large for every light.
uvec4 tilesOfSphere(const vec3 sphere, const float radius, const vec2 slab, const TileSize size,
                    const uvec2 tiles) {
    vec2 depths = depthsOfSphere(sphere, radius, slab);
    float beyond = max(max(slab.x - sphere.z, sphere.z - slab.y), 0.0);
    float cut = sqrt(max(radius * radius - beyond * beyond, 0.0));
    vec2 z = vec2(depths.x, max(depths.x, depths.y));
    uvec4 found = uvec4(tilesCovered(sphere.x - cut, sphere.x + cut, z, size.centre.x, size, tiles.x),
                        tilesCovered(sphere.y - cut, sphere.y + cut, z, size.centre.y, size, tiles.y));
    return depths.x <= depths.y ? found : uvec4(0u);
}

// Columns [x, y) of one row of tiles that the sphere may overlap in the slab; empty if y <= x. `squared`:
// lower bound of the squared distance from its centre to the row within the slab. By Pythagoras, the
// sphere extends along x by at most the root of radius^2 - squared there.
uvec2 columnsOfSphere(const vec3 sphere, const float radius, const vec2 slab, const float squared,
                      const TileSize size, const uint columns) {
    vec2 depths = depthsOfSphere(sphere, radius, slab);
    float left = radius * radius - squared, cut = sqrt(max(left, 0.0));
    vec2 z = vec2(depths.x, max(depths.x, depths.y));
    uvec2 found = tilesCovered(sphere.x - cut, sphere.x + cut, z, size.centre.x, size, columns);
    return left >= 0.0 && depths.x <= depths.y ? found : uvec2(0u);
}

#endif
