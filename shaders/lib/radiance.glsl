// SPDX-License-Identifier: MIT
#ifndef RADIANCE_GLSL
#define RADIANCE_GLSL

#include "shaders/lib/contract.glsl"
#include "shaders/lib/flushed.glsl"

// W/(sr m^2), towards the viewer.
struct Radiance {
    vec3 diffuse;
    vec3 specular;
    vec3 ambient;
    vec3 emission;
    float sun_visibility;  // 0 to 1; 1 where no sun casts
    float local_light;     // luminance of the irradiance of points and spots that cast, W/m^2,
    float local_seen;      // and what is seen of it
    vec3 transmittance;    // share of all this that haze lets through
    vec3 haze;             // and what haze adds
    vec3 environment;      // of diffuse and specular: the environment's part
};

// What a pixel starts from.
Radiance noRadiance() {
    return Radiance(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 1.0, 0.0, 0.0, vec3(1.0), vec3(0.0),
                    vec3(0.0));
}

vec3 lit(Radiance radiance) {
    vec3 sum = ((radiance.diffuse + radiance.specular) + radiance.ambient) + radiance.emission;
    if (on(feature_haze)) sum = sum * radiance.transmittance + radiance.haze;
    return flushed(sum);
}

// The mean over the points and spots that cast, weighted by their light; 1 where none does.
float localVisibility(Radiance radiance) {
    return radiance.local_light > 0.0 ? radiance.local_seen / radiance.local_light : 1.0;
}

#endif
