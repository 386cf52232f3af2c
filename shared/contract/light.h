// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_LIGHT_H
#define DIPTYCH_CONTRACT_LIGHT_H

#include "types.h"

CONTRACT_BEGIN

// A light as the shaders see it: KHR_lights_punctual, with everything that does not depend on the pixel
// worked out. Directional lights come first in the buffer, the others after them, both in scene order,
// and every sum over lights runs in that order.
struct Light {
    vec3 position;     // from the camera, world axes, m; directional: unused
    float range;       // m; exactly zero light from there on; infinity where the light has none
    vec3 intensity;    // W/sr (candela); directional: W/m^2 (lux)
    float cone_scale;  // spot: 1 / (cos inner - cos outer); point: 0
    vec3 direction;    // unit, in which the light travels, world
    float cone_offset; // spot: -cos outer * cone_scale; point: 1
};

CONTRACT_END

#endif
