// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_LIGHT_H
#define DIPTYCH_CONTRACT_LIGHT_H

#include "types.h"

CONTRACT_BEGIN

// A light as the shaders read it: KHR_lights_punctual, with everything that does not depend on the pixel
// computed in advance. The buffer holds directional lights first, then points, spots and area lights, each
// kind in the scene's order, and last a null light that gives nothing, with which lists are padded; every sum
// over lights runs in that order, whatever chose the lights. Shaders read it as a texel buffer of four
// floats.
struct Light {
    vec3 position;                // from the camera, world axes, m; directional: unit, to the light
    float inverse_range_squared;  // 1/m^2: d^2 times it is below 1 where light arrives; 0 without a range
    vec3 intensity;               // W/sr (candela); directional: W/m^2 (lux)
    float range;                  // m; infinity where the light has none
};

#define LIGHT_OF_TEXELS(a, b) Light(a.xyz, a.w, b.xyz, b.w)
CONTRACT_LANE(Light, position, 0, 0);
CONTRACT_LANE(Light, inverse_range_squared, 0, 3);
CONTRACT_LANE(Light, intensity, 1, 0);
CONTRACT_LANE(Light, range, 1, 3);
CONTRACT_TEXELS(Light, 2);

// The cone of a spot. The i-th cone belongs to the i-th spot.
struct SpotCone {
    vec3 direction;  // unit, in which the light travels, world
    float scale;     // 1 / (cos inner - cos outer)
    float offset;    // -cos outer * scale
    vec3 padding;    // to two texels of four floats, as a Light is
};
#define SPOT_CONE_OF_TEXELS(a, b) SpotCone(a.xyz, a.w, b.x, b.yzw)
CONTRACT_LANE(SpotCone, direction, 0, 0);
CONTRACT_LANE(SpotCone, scale, 0, 3);
CONTRACT_LANE(SpotCone, offset, 1, 0);
CONTRACT_LANE(SpotCone, padding, 1, 1);
CONTRACT_TEXELS(SpotCone, 2);

CONTRACT_END

#endif
