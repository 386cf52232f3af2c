// SPDX-License-Identifier: MIT
#ifndef RADIANCE_GLSL
#define RADIANCE_GLSL

// W/(sr m^2), towards the viewer.
struct Radiance {
    vec3 diffuse;
    vec3 specular;
    vec3 ambient;
    vec3 emission;
};

vec3 lit(Radiance radiance) {
    vec3 sum = ((radiance.diffuse + radiance.specular) + radiance.ambient) + radiance.emission;
    return sum;
}

#endif
