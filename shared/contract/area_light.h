// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_AREA_LIGHT_H
#define DIPTYCH_CONTRACT_AREA_LIGHT_H

#include "types.h"

// The kinds of area lights, in the order of the light buffer. The name is the "type" in JSON, and the first
// word of the kind's functions in shaders/lib/lights. Cost: of its shading, in point lights
// (shared/light/MEASURED.md, "Errors of area lights").
//
// tests/architecture/README.md lists the files to change for a new kind.
//   number  name  cost
// clang-format off
#define AREA_KINDS(X) \
    X(0, rect, 5)     \
    X(1, disc, 11)    \
    X(2, tube, 37)
// clang-format on

CONTRACT_BEGIN

// Shape of a rectangle, disc or tube. Its Light stores the centre as position, the range from the centre,
// and as intensity the radiance in W/(sr m^2), constant over the shape and all directions.
// Area lights are the last lights. Shape i belongs to area light i.
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

// FEATURE_area_lights: a sum of the kinds in the scene. AREA_POINTS evaluates them as representative
// points; without it they use linearly transformed cosines.
#define DIPTYCH_AREA_BIT(number, name, cost) CONTRACT_CONST(uint, AREA_##name, 1u << number);
AREA_KINDS(DIPTYCH_AREA_BIT)
#undef DIPTYCH_AREA_BIT
#define DIPTYCH_AREA_ONE(number, name, cost) +1
CONTRACT_CONST(uint, AREA_KIND_COUNT, 0 AREA_KINDS(DIPTYCH_AREA_ONE));
#undef DIPTYCH_AREA_ONE
CONTRACT_CONST(uint, AREA_POINTS, 1u << AREA_KIND_COUNT);

CONTRACT_END

#endif
