// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_VIEW_H
#define DIPTYCH_CONTRACT_VIEW_H

#include "types.h"

CONTRACT_BEGIN

// The camera. GPU space has world axes and the camera as its origin, so no coordinate here is large.
// Depth is reversed: 1 at the near plane, 0 at the far plane or at infinity.
//
// A pixel's position from its depth, the only position that shading uses, in both paths:
//     d        = (depth_numerator.x + depth_numerator.y * z) / (depth_denominator.x + depth_denominator.y *
//     z) position = origin(p) + direction(p) * d,   origin, direction affine in the pixel centre p
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
    vec3 backward;  // unit, from the scene to the camera: the view vector of an orthographic one
    uint directional_light_count;
    uint point_light_count;
    uint spot_light_count;
    uint rect_light_count;
    uint disc_light_count;
    uint tube_light_count;
    vec3 ambient;  // W/(sr m^2), from everywhere
};

// What a fragment reads of View and LightGrid, as five texels of four. Perspective only: the rays of an
// orthographic camera are not in it.
struct PackedView {
    vec3 direction_0;
    float depth_numerator_0;
    vec3 direction_x;
    float depth_numerator_z;
    vec3 direction_y;
    float depth_denominator_0;
    float depth_denominator_z;
    float slice_offset;
    uint shifts;  // of a slice, and from bit 16 of a tile
    uint tiles;   // across, and from bit 16 down
    uint slices;
    uint directional_light_count;
    uint point_light_count;
    uint spot_light_count;
};

CONTRACT_END

#endif
