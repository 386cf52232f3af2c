// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_AREA_LIGHT_H
#define DIPTYCH_CONTRACT_AREA_LIGHT_H

#include "types.h"

CONTRACT_BEGIN

// Shape of a rectangle, disc or tube. Its Light stores the centre as position, the range from the centre,
// and as intensity the radiance in W/(sr m^2), constant over the shape and all directions.
// Area lights are the last lights: rectangles, discs, tubes. Shape i belongs to area light i.
struct AreaLight {
    vec3 x;  // m, from the centre; rectangle: to the middle of a side; disc: to the rim; tube: to an end
    float radius;     // m; disc, tube
    vec3 y;           // rectangle, disc: the other half axis, orthogonal to x; cross(x, y) points along
                      // direction
    float extent;     // m; radius of the bounding sphere
    vec3 direction;   // unit; rectangle, disc: emission direction; tube: along x
    float two_sided;  // 1: a rectangle or disc emits on both sides
};
#define AREA_LIGHT_OF_TEXELS(a, b, c) AreaLight(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w)
CONTRACT_LANE(AreaLight, x, 0, 0);
CONTRACT_LANE(AreaLight, radius, 0, 3);
CONTRACT_LANE(AreaLight, y, 1, 0);
CONTRACT_LANE(AreaLight, extent, 1, 3);
CONTRACT_LANE(AreaLight, direction, 2, 0);
CONTRACT_LANE(AreaLight, two_sided, 2, 3);
CONTRACT_TEXELS(AreaLight, 3);

// FEATURE_area_lights: a sum of the shapes in the scene. AREA_POINTS evaluates them as representative
// points; without it they use linearly transformed cosines.
CONTRACT_CONST(uint, AREA_RECTS, 1);
CONTRACT_CONST(uint, AREA_DISCS, 2);
CONTRACT_CONST(uint, AREA_TUBES, 4);
CONTRACT_CONST(uint, AREA_POINTS, 8);

CONTRACT_END

#endif
