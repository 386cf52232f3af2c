// SPDX-License-Identifier: MIT
// One surface, one sum over lights, for every path.
#ifndef SHADE_GLSL
#define SHADE_GLSL

#include "shaders/lib/brdf.glsl"
#include "shaders/lib/lights.glsl"
#include "shaders/lib/position.glsl"
#include "shaders/lib/surface.glsl"

// W/(sr m^2), towards the viewer.
struct Radiance {
    vec3 diffuse;
    vec3 specular;
    vec3 emission;
};

vec3 lit(Radiance radiance) {
    precise vec3 sum = (radiance.diffuse + radiance.specular) + radiance.emission;
    return sum;
}

// Every light, in the buffer's order. Occlusion is for ambient light alone and dims nothing here.
Radiance shade(Surface s) {
    vec3 v = viewVector(s.position);
    Brdf brdf = makeBrdf(s, v);
    precise Radiance radiance = Radiance(vec3(0.0), vec3(0.0), s.emission);
    if (on(feature_directional_lights)) {
        for (uint i = 0; i < view.directional_light_count; ++i) {
            Incident light = fromDirectionalLight(lights[i]);
            addLight(brdf, s.normal, v, light.direction, light.irradiance, radiance.diffuse, radiance.specular);
        }
    }
    uint first_spot = view.directional_light_count + view.point_light_count;
    if (on(feature_point_lights)) {
        for (uint i = view.directional_light_count; i < first_spot; ++i) {
            Incident light = fromPointLight(lights[i], s.position);
            addLight(brdf, s.normal, v, light.direction, light.irradiance, radiance.diffuse, radiance.specular);
        }
    }
    if (on(feature_spot_lights)) {
        for (uint i = 0; i < view.spot_light_count; ++i) {
            Incident light = fromSpotLight(lights[first_spot + i], spot_cones[i], s.position);
            addLight(brdf, s.normal, v, light.direction, light.irradiance, radiance.diffuse, radiance.specular);
        }
    }
    return radiance;
}

#endif
