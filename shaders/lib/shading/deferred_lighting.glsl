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
Radiance partialSumsHere() {
    Radiance radiance = radianceHere();
    radiance.diffuse = flushed(radiance.diffuse);
    radiance.specular = flushed(radiance.specular);
    radiance.clearcoat = flushed(radiance.clearcoat);
    radiance.sheen = flushed(radiance.sheen);
    radiance.transmission = flushed(radiance.transmission);
    return radiance;
}

#endif
