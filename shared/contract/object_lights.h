// SPDX-License-Identifier: MIT
// --assign per_object: the lights of each draw, chosen on the CPU (shared/light/per_object.h).
#ifndef DIPTYCH_CONTRACT_OBJECT_LIGHTS_H
#define DIPTYCH_CONTRACT_OBJECT_LIGHTS_H

#include "types.h"

CONTRACT_BEGIN

// Bits of FEATURE_object_lights.
CONTRACT_CONST(uint, OBJECT_LIGHTS_LISTS, 1);   // lists of lights that are shaded per pixel
CONTRACT_CONST(uint, OBJECT_LIGHTS_VERTEX, 2);  // and of some that are shaded per vertex
CONTRACT_CONST(uint, OBJECT_LIGHTS_SH, 4);      // and the rest as spherical harmonics

// An entry of a list: a light, and the share of it that this list gives. The rest of a light that is shaded
// per pixel goes to the vertex lights, that of a vertex light to the harmonics.
struct ObjectLight {
    uint light;    // into the lights
    float weight;  // in (0, 1]
};

// Irradiance by the normal as spherical harmonics up to L2, W/m^2, by colour:
//   E(n) = constant + linear_x n.x + linear_y n.y + linear_z n.z + xx (n.x^2 - n.z^2) + yy (n.y^2 - n.z^2)
//          + 2 (xy n.x n.y + yz n.y n.z + xz n.x n.z)
// (Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", equation 12,
// whose matrix of a unit n loses one row to its trace.)
struct ObjectIrradiance {
    vec3 constant;
    vec3 linear_x, linear_y, linear_z;
    vec3 xx, yy, xy, yz, xz;
};

// A draw's lights: entries [begin, local_begin) are directional, up to point_end points, up to spot_end
// spots, up to area_end area lights, each in the order of the lights; then those of the vertices, of which
// none is an area light.
struct ObjectLights {
    uint begin, local_begin, point_end, spot_end, area_end;
    uint vertex_directional_end, vertex_point_end, vertex_end;
    ObjectIrradiance irradiance;  // of the rest
};

CONTRACT_END

#endif
