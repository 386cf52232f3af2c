// SPDX-License-Identifier: MIT
// KHR_materials_diffuse_transmission: a Lambertian lobe on the far side of a thin surface. Light from behind
// is reflected by a material that is the surface's mirror image: it meets the same layer on its way.
#ifndef DIFFUSE_TRANSMISSION_GLSL
#define DIFFUSE_TRANSMISSION_GLSL

#include "shaders/lib/environment/environment.glsl"
#include "shaders/lib/shading/brdf.glsl"

// The mirror image of a material and its viewer.
struct Behind {
    Brdf brdf;   // its base is the transmitted one
    vec3 n, v;
};

Behind makeBehind(Brdf brdf, vec3 n, vec3 v) {
    brdf.diffuse = brdf.through;
    return Behind(brdf, -n, v - n * (2.0 * dot(n, v)));
}

// l: unit vector to the light. `irradiance`: W/m^2, perpendicular to `l`. Radiance, W/(sr m^2).
vec3 throughSurface(const Behind b, const vec3 l, const vec3 irradiance) {
    Reflected reflected = reflectedLight(b.brdf, b.n, b.v, l, true);
    return reflected.base * (irradiance * reflected.n_dot_l);
}

// The same of uniform radiance 1.
vec3 uniformThroughSurface(const Behind b) { return b.brdf.diffuse * PI * baseShare(b.brdf); }

#endif
