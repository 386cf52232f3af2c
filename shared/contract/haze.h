// SPDX-License-Identifier: MIT
// Participating medium between the camera and the scene, as texels of four floats. For the model see
// shared/environment/README.md.
#ifndef DIPTYCH_CONTRACT_HAZE_H
#define DIPTYCH_CONTRACT_HAZE_H

#include "types.h"

CONTRACT_BEGIN

// FEATURE_haze, a sum; 0: no haze.
CONTRACT_CONST(uint, HAZE_THERE, 1);    // one scale height and one sun radiance per ray, in closed form,
                                        // unless:
CONTRACT_CONST(uint, HAZE_MARCHED, 2);  // ray marching, with two scale heights and a sun attenuated by the
                                        // medium
CONTRACT_CONST(uint, HAZE_SUN, 4);      // there is a sun
CONTRACT_CONST(uint, HAZE_AMBIENT, 8);  // there is ambient light

// Medium along a ray, and the parameters that all rays share. A source is the radiance of an optically
// thick medium: scattering over extinction.
struct Haze {
    vec3 extinction;       // at height 0, 1/m; marching: one value for all colours; determines the
                           // steps
    float inverse_height;  // 1/m, of the one scale height
    vec3 to_sun;           // unit
    float camera_height;   // m, above height 0
    vec3 rayleigh;         // source over 1 + cos^2 of the angle to the sun, W/(sr m^2)
    float phase_0;         // (1 - g)^2
    vec3 mie;              // source over (1 + cos^2) (phase_0 + phase_1 |ray - to_sun|^2)^-1.5, W/(sr m^2)
    float phase_1;         // g
    vec3 ambient;          // source, W/(sr m^2)
    float steps;           // number of marching steps
};
CONTRACT_LANE(Haze, extinction, 0, 0);
CONTRACT_LANE(Haze, to_sun, 1, 0);
CONTRACT_LANE(Haze, rayleigh, 2, 0);
CONTRACT_LANE(Haze, mie, 3, 0);
CONTRACT_LANE(Haze, ambient, 4, 0);
CONTRACT_LANE(Haze, steps, 4, 3);
CONTRACT_TEXELS(Haze, 5);

// Additional values for marching. Haze::rayleigh and Haze::mie are then the sun's irradiance times the
// constant factors of the phase functions, W/(sr m^2). Haze::ambient is then the ambient radiance.
struct HazeMarch {
    vec3 rayleigh;           // scattering at height 0, 1/m; molecules do not absorb
    float rayleigh_inverse;  // 1/m, of their scale height
    vec3 mie;                // scattering by aerosols
    float mie_inverse;
    vec3 mie_extinction;
    float inverse_sun_up;  // 1 / sine of the sun's elevation
};
CONTRACT_LANE(HazeMarch, rayleigh, 0, 0);
CONTRACT_LANE(HazeMarch, mie, 1, 0);
CONTRACT_LANE(HazeMarch, mie_extinction, 2, 0);
CONTRACT_LANE(HazeMarch, inverse_sun_up, 2, 3);
CONTRACT_TEXELS(HazeMarch, 3);

// Optical depth at which marching of an infinite ray ends; e^-40 of the radiance beyond remains.
CONTRACT_CONST(float, HAZE_ENDLESS_DEPTH, 40.0f);
// Distance at height 0 that is opaque for every extinction, m. The extinction is at least 1e-25 1/m.
CONTRACT_CONST(float, HAZE_OPAQUE_METRES, 1e30f);

CONTRACT_END

#define HAZE_OF_TEXELS(a, b, c, d, e) Haze(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d.xyz, d.w, e.xyz, e.w)
#define HAZE_MARCH_OF_TEXELS(a, b, c) HazeMarch(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w)
CONTRACT_BEGIN
CONTRACT_CONST(uint, HAZE_TEXELS, 5);
CONTRACT_CONST(uint, HAZE_MARCH_TEXELS, 3);
CONTRACT_END

#endif
