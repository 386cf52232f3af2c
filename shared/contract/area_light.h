// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_AREA_LIGHT_H
#define DIPTYCH_CONTRACT_AREA_LIGHT_H

#include "types.h"

CONTRACT_BEGIN

// The shape of a rectangle, disc or tube. Its Light has the centre as position, the radiance in W/(sr m^2),
// the same from every point into every direction, as intensity, and the range from the centre. Area lights
// come last in the order of lights: rectangles, discs, tubes; the i-th shape belongs to the i-th area light.
struct AreaLight {
    vec3 x;  // m; from the centre: rectangle: to the middle of a side; disc: to the rim; tube: to an end
    float radius;     // m; disc, tube
    vec3 y;           // rectangle, disc: the other half axis, cross(x, y) along direction
    float extent;     // m; radius of the sphere around it
    vec3 direction;   // unit; rectangle, disc: in which it shines; tube: along x
    float two_sided;  // 1: rectangle, disc: to both sides
};
#define AREA_LIGHT_OF_TEXELS(a, b, c) AreaLight(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w)
CONTRACT_LANE(AreaLight, x, 0, 0);
CONTRACT_LANE(AreaLight, radius, 0, 3);
CONTRACT_LANE(AreaLight, y, 1, 0);
CONTRACT_LANE(AreaLight, extent, 1, 3);
CONTRACT_LANE(AreaLight, direction, 2, 0);
CONTRACT_LANE(AreaLight, two_sided, 2, 3);
CONTRACT_TEXELS(AreaLight, 3);

// FEATURE_area_lights: the shapes that the scene has, and AREA_POINTS where each is evaluated by a
// representative point; else by linearly transformed cosines.
CONTRACT_CONST(uint, AREA_RECTS, 1);
CONTRACT_CONST(uint, AREA_DISCS, 2);
CONTRACT_CONST(uint, AREA_TUBES, 4);
CONTRACT_CONST(uint, AREA_POINTS, 8);

CONTRACT_END

#endif
