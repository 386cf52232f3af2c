// SPDX-License-Identifier: MIT
// --assign per_object: light lists per draw, built on the CPU (shared/light/per_object.h).
#ifndef DIPTYCH_CONTRACT_OBJECT_LIGHTS_H
#define DIPTYCH_CONTRACT_OBJECT_LIGHTS_H

#include "types.h"

CONTRACT_BEGIN

// Bits of FEATURE_object_lights.
CONTRACT_CONST(uint, OBJECT_LIGHTS_LISTS, 1);   // lights shaded per pixel
CONTRACT_CONST(uint, OBJECT_LIGHTS_VERTEX, 2);  // also lights shaded per vertex
CONTRACT_CONST(uint, OBJECT_LIGHTS_SH, 4);      // the rest as spherical harmonics

// Entry of a list: a light, and the fraction of it that this list contributes. The remainder of a
// per-pixel light goes to the vertex lights, that of a vertex light to the harmonics.
struct ObjectLight {
    uint light;    // index into the lights
    float weight;  // in (0, 1]
};

// Irradiance by normal as spherical harmonics up to L2, W/m^2, per colour:
//   E(n) = constant + linear_x n.x + linear_y n.y + linear_z n.z + xx (n.x^2 - n.z^2) + yy (n.y^2 - n.z^2)
//          + 2 (xy n.x n.y + yz n.y n.z + xz n.x n.z)
// (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", equation
// 12; for a unit n its matrix needs one row less, because of the trace.)
struct ObjectIrradiance {
    vec3 constant;
    vec3 linear_x, linear_y, linear_z;
    vec3 xx, yy, xy, yz, xz;
};

// A draw's lights: entries [begin, local_begin) are directional, then points up to point_end, spots up to
// spot_end, area lights up to area_end, each in light order. The vertex lights follow; they include no
// area light.
struct ObjectLights {
    uint begin, local_begin, point_end, spot_end, area_end;
    uint vertex_directional_end, vertex_point_end, vertex_end;
    ObjectIrradiance irradiance;  // of the remaining lights
};

CONTRACT_END

#endif
