// SPDX-License-Identifier: MIT
#ifndef RADIANCE_GLSL
#define RADIANCE_GLSL

#include "shaders/lib/contract.glsl"
#include "shaders/lib/math/flushed.glsl"

// W/(sr m^2), towards the viewer.
struct Radiance {
    vec3 diffuse;
    vec3 specular;
    vec3 ambient;
    vec3 emission;
    float sun_visibility;  // 0 to 1; 1 without a shadow-casting directional light
    float local_light;     // luminance of the irradiance of shadow-casting point and spot lights, W/m^2
    float local_seen;      // the visible part of local_light
    vec3 transmittance;    // fraction of all this that haze transmits
    vec3 haze;             // light that haze adds
    vec3 environment;      // the environment's part of diffuse and specular
    vec3 clearcoat;        // the clear coat's part of specular and ambient
    vec3 sheen;            // the sheen's part of both
    vec3 behind;           // light of surfaces behind one with transmission; haze does not dim it again
    vec3 transmission;     // the transmitted part of behind, or of diffuse and ambient
};

Radiance noRadiance() {
    return Radiance(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 1.0, 0.0, 0.0, vec3(1.0), vec3(0.0),
                    vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
}

vec3 lit(const Radiance radiance) {
    vec3 sum = ((radiance.diffuse + radiance.specular) + radiance.ambient) + radiance.emission;
    if (on(feature_haze)) sum = sum * radiance.transmittance + radiance.haze;
    if (on(feature_transmission)) sum += radiance.behind;
    return flushed(sum);
}

// Mean over shadow-casting point and spot lights, weighted by their light; 1 without any.
float localVisibility(const Radiance radiance) {
    return radiance.local_light > 0.0 ? radiance.local_seen / radiance.local_light : 1.0;
}

#endif
