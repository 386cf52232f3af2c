// SPDX-License-Identifier: MIT
// What deferred lighting makes of a pixel, in a fragment shader and in a compute shader alike.
#ifndef DEFERRED_LIGHTING_GLSL
#define DEFERRED_LIGHTING_GLSL

#include "shaders/lib/deferred.glsl"
#include "shaders/lib/shade.glsl"

Radiance radianceHere() {
    float z;
    Surface s = deferredSurface(z);
    return shade(s, lightsAt(middleHere(), z));
}

// The texel of lit.
vec4 litHere() { return vec4(lit(radianceHere()), 1.0); }

// The texels of the sums that a light batch leaves to the next one.
struct PartialSums {
    vec4 diffuse, specular;
};
PartialSums partialSumsHere() {
    Radiance radiance = radianceHere();
    return PartialSums(vec4(flushed(radiance.diffuse), radiance.local_seen),
                       vec4(flushed(radiance.specular), radiance.local_light));
}

#endif
