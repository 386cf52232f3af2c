// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_LIGHT_H
#define DIPTYCH_CONTRACT_LIGHT_H

#include "types.h"

CONTRACT_BEGIN

// A light as shaders read it: KHR_lights_punctual with everything precomputed that does not depend on the
// pixel. The buffer stores directional, point, spot and area lights, each type in scene order. A null
// light without radiance comes last and pads lists. Every sum over lights runs in this order, with or
// without light lists. Shaders read two texels of four floats.
struct Light {
    vec3 position;                // world axes from the camera, m; directional: unit, to the light
    float inverse_range_squared;  // 1/m^2: light arrives where d^2 times it is below 1; 0: infinite range
    vec3 intensity;               // W/sr (candela); directional: W/m^2 (lux)
    float range;                  // m; may be infinite
};

#define LIGHT_OF_TEXELS(a, b) Light(a.xyz, a.w, b.xyz, b.w)
CONTRACT_LANE(Light, position, 0, 0);
CONTRACT_LANE(Light, inverse_range_squared, 0, 3);
CONTRACT_LANE(Light, intensity, 1, 0);
CONTRACT_LANE(Light, range, 1, 3);
CONTRACT_TEXELS(Light, 2);

// Cone of a spot. Cone i belongs to spot i.
struct SpotCone {
    vec3 direction;  // unit, world; direction in which the light travels
    float scale;     // 1 / (cos inner - cos outer)
    float offset;    // -cos outer * scale
    vec3 padding;    // to two texels of four floats
};
#define SPOT_CONE_OF_TEXELS(a, b) SpotCone(a.xyz, a.w, b.x, b.yzw)
CONTRACT_LANE(SpotCone, direction, 0, 0);
CONTRACT_LANE(SpotCone, scale, 0, 3);
CONTRACT_LANE(SpotCone, offset, 1, 0);
CONTRACT_LANE(SpotCone, padding, 1, 1);
CONTRACT_TEXELS(SpotCone, 2);

CONTRACT_END

#endif
