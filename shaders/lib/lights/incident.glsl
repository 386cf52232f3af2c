// SPDX-License-Identifier: MIT
#ifndef INCIDENT_GLSL
#define INCIDENT_GLSL

// Light that arrives from one direction.
struct Incident {
    vec3 direction;   // unit, to the light
    vec3 irradiance;  // W/m^2, perpendicular to the direction
};

#endif
