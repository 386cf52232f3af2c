// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_VIEW_H
#define DIPTYCH_CONTRACT_VIEW_H

#include "area_light.h"
#include "types.h"

CONTRACT_BEGIN

// The camera. GPU space has world axes and the camera as its origin, which keeps coordinates small. Depth
// is reversed: 1 at the near plane, 0 at the far plane or at infinity.
//
// Shading reconstructs the position of a pixel from its centre p, in pixels, and its depth z:
//     position = origin(p) + direction(p) * d
//     d = (depth_numerator.x + z * depth_numerator.y) / (depth_denominator.x + z * depth_denominator.y)
// origin and direction are affine in p.
struct View {
    mat4 clip_from_world;  // world axes, camera as origin
    vec3 origin_0;
    vec3 origin_x;  // per pixel; zero for a perspective camera
    vec3 origin_y;
    vec3 direction_0;
    vec3 direction_x;  // per pixel; zero for an orthographic camera
    vec3 direction_y;
    vec2 depth_numerator;
    vec2 depth_denominator;
    vec3 backward;  // unit, from the scene to the camera: view vector of an orthographic camera
    uint directional_light_count;
    uint point_light_count;
    uint spot_light_count;
    uint area_ends[AREA_KIND_COUNT];  // of each kind's indices among the area lights
    vec3 ambient;                     // W/(sr m^2), uniform
    float specular_aa_limit;          // kappa of shaders/lib/surface/specular_aa.glsl
    // Addresses of the lights' buffers, for FEATURE_addressed_lights.
    uvec2 lights;
    uvec2 spot_cones;
    uvec2 area_lights;
};

CONTRACT_END

// Members of View and LightGrid that fragments read, as texels of four 32-bit components. C++ packs and
// GLSL unpacks from this table. Perspective only: it omits the rays of an orthographic camera. Each row
// fills one component.
//   FLOAT, UINT(texel, lane, member)    SHORTS(texel, lane, low 16 bits, high 16 bits)
//   BYTES(texel, lane, lowest 8 bits, next 8 bits, high 16 bits)
// clang-format off
#define PACKED_VIEW(FLOAT, UINT)                \
    FLOAT(0, x, direction_0.x)                  \
    FLOAT(0, y, direction_0.y)                  \
    FLOAT(0, z, direction_0.z)                  \
    FLOAT(0, w, depth_numerator.x)              \
    FLOAT(1, x, direction_x.x)                  \
    FLOAT(1, y, direction_x.y)                  \
    FLOAT(1, z, direction_x.z)                  \
    FLOAT(1, w, depth_numerator.y)              \
    FLOAT(2, x, direction_y.x)                  \
    FLOAT(2, y, direction_y.y)                  \
    FLOAT(2, z, direction_y.z)                  \
    FLOAT(2, w, depth_denominator.x)            \
    FLOAT(3, x, depth_denominator.y)            \
    FLOAT(4, x, specular_aa_limit)              \
    UINT(4, y, directional_light_count)         \
    UINT(4, z, point_light_count)               \
    UINT(4, w, spot_light_count)
#define PACKED_GRID(FLOAT, SHORTS, BYTES)       \
    FLOAT(3, y, slice_offset)                   \
    BYTES(3, z, slice_shift, tile_shift, slices) \
    SHORTS(3, w, tiles.x, tiles.y)
// clang-format on

CONTRACT_BEGIN
CONTRACT_CONST(uint, PACKED_VIEW_TEXELS, 5);

// Storage of the scene's depth; shaders/lib/geometry/reversed_depth.glsl reads it.
CONTRACT_CONST(uint, DEPTH_REVERSED, 0);  // unchanged
CONTRACT_CONST(uint, DEPTH_STANDARD, 1);  // 1 - z; the far end is 1 - STANDARD_DEPTH_FIRST
CONTRACT_CONST(uint, DEPTH_STEPS_24, 2);  // in steps of 1 / (2^24 - 1); the first step is the far end
CONTRACT_CONST(uint, DEPTH_STEPS_16, 3);  // likewise, in steps of 1 / (2^16 - 1)
CONTRACT_CONST(float, STANDARD_DEPTH_FIRST, 2.3841858e-7f);  // 2^-22
CONTRACT_END

#endif
