// SPDX-License-Identifier: MIT
// Air between the camera and what it sees, as shaders read it: texels of four floats. The model stands in
// shared/environment/README.md.
#ifndef DIPTYCH_CONTRACT_HAZE_H
#define DIPTYCH_CONTRACT_HAZE_H

#include "types.h"

CONTRACT_BEGIN

// The feature `haze`, a sum; 0: there is none.
CONTRACT_CONST(uint, HAZE_THERE, 1);    // one height and one sun for each ray, in closed form, unless:
CONTRACT_CONST(uint, HAZE_MARCHED, 2);  // by steps, with two heights and a sun that the air dims
CONTRACT_CONST(uint, HAZE_SUN, 4);      // there is a sun
CONTRACT_CONST(uint, HAZE_AMBIENT, 8);  // there is ambient light

// The same air all along a ray, and what every ray shares. A source is the radiance that a thick layer of air
// would have: what it scatters to the viewer over what it takes away.
struct Haze {
    vec3 extinction;       // at height 0, 1/m; of a march one for all colours, by which it places steps
    float inverse_height;  // 1/m, of the one height
    vec3 to_sun;           // unit
    float camera_height;   // m, over height 0
    vec3 rayleigh;         // source over 1 + cos^2 of the angle to the sun, W/(sr m^2)
    float phase_0;         // (1 - g)^2
    vec3 mie;              // source over that and (phase_0 + phase_1 |ray - to_sun|^2)^-1.5
    float phase_1;         // g
    vec3 ambient;          // source, W/(sr m^2)
    float steps;           // of a march
};
CONTRACT_LANE(Haze, extinction, 0, 0);
CONTRACT_LANE(Haze, to_sun, 1, 0);
CONTRACT_LANE(Haze, rayleigh, 2, 0);
CONTRACT_LANE(Haze, mie, 3, 0);
CONTRACT_LANE(Haze, ambient, 4, 0);
CONTRACT_LANE(Haze, steps, 4, 3);
CONTRACT_TEXELS(Haze, 5);

// What a march has beside; `rayleigh` and `mie` of Haze are then the sun's irradiance times what is constant
// of the phase functions, W/(sr m^2), and `ambient` the radiance from everywhere.
struct HazeMarch {
    vec3 rayleigh;           // scattering at height 0, 1/m: molecules absorb nothing
    float rayleigh_inverse;  // 1/m, of their height
    vec3 mie;                // scattering of aerosols
    float mie_inverse;
    vec3 mie_extinction;
    float inverse_sun_up;  // 1 / sine of the sun's elevation
};
CONTRACT_LANE(HazeMarch, rayleigh, 0, 0);
CONTRACT_LANE(HazeMarch, mie, 1, 0);
CONTRACT_LANE(HazeMarch, mie_extinction, 2, 0);
CONTRACT_LANE(HazeMarch, inverse_sun_up, 2, 3);
CONTRACT_TEXELS(HazeMarch, 3);

// Optical depth at which a march of an endless ray ends: what lies beyond is e^-40 of it.
CONTRACT_CONST(float, HAZE_ENDLESS_DEPTH, 40.0f);
// Metres of air at height 0 that let nothing through, whatever the extinction, which is at least 1e-25 1/m.
CONTRACT_CONST(float, HAZE_OPAQUE_METRES, 1e30f);

CONTRACT_END

#define HAZE_OF_TEXELS(a, b, c, d, e) Haze(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d.xyz, d.w, e.xyz, e.w)
#define HAZE_MARCH_OF_TEXELS(a, b, c) HazeMarch(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w)
CONTRACT_BEGIN
CONTRACT_CONST(uint, HAZE_TEXELS, 5);
CONTRACT_CONST(uint, HAZE_MARCH_TEXELS, 3);
CONTRACT_END

#endif
