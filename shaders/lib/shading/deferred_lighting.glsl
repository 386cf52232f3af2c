// SPDX-License-Identifier: MIT
// Deferred lighting of one pixel, shared by the fragment and the compute shader.
#ifndef DEFERRED_LIGHTING_GLSL
#define DEFERRED_LIGHTING_GLSL

#include "shaders/lib/surface/deferred.glsl"
#include "shaders/lib/shading/shade.glsl"

Radiance radianceHere() {
    float z;
    Surface s = deferredSurface(z);
    return shade(s, lightsAt(middleHere(), z));
}

vec4 litHere() { return vec4(lit(radianceHere()), 1.0); }

// Sums that a light batch passes to the next one.
struct PartialSums {
    vec4 diffuse, specular;
    vec4 clearcoat, sheen;  // their parts of specular
};
PartialSums partialSumsHere() {
    Radiance radiance = radianceHere();
    return PartialSums(vec4(flushed(radiance.diffuse), radiance.local_seen),
                       vec4(flushed(radiance.specular), radiance.local_light),
                       vec4(flushed(radiance.clearcoat), 0.0), vec4(flushed(radiance.sheen), 0.0));
}

#endif
