// SPDX-License-Identifier: MIT
// KHR_materials_diffuse_transmission: a Lambertian lobe on the far side of a thin surface. Light from behind
// is reflected by a material that is the surface's mirror image: it meets the same layer on its way.
#ifndef DIFFUSE_TRANSMISSION_GLSL
#define DIFFUSE_TRANSMISSION_GLSL

#include "shaders/lib/shading/ambient.glsl"

// The mirror image of a material and its viewer; its base is the transmitted one.
Reflector makeBehind(Brdf brdf, const vec3 n, const vec3 v) {
    brdf.diffuse = brdf.through;
    return makeReflector(brdf, -n, v - n * (2.0 * dot(n, v)));
}

#endif
