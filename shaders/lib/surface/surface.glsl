// SPDX-License-Identifier: MIT
// A surface point, as shading sees it. Forward+ makes it from the material (material.glsl), deferred
// lighting from the G-buffer (gbuffer.glsl). All later code is shared.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL

#include "shaders/lib/contract.glsl"

struct Surface {
    vec3 position;          // world axes, camera as origin, m
    vec3 normal;            // unit, shading
    vec3 geometric_normal;  // unit, of the triangle, towards the viewer; for shadow bias
    vec3 triangle_normal;   // the same before forward+ quantises it; only for the channel
    vec3 albedo;            // base colour, linear Rec.709
    float metallic;
    float roughness;        // perceptual
    float occlusion;        // 1: open; dims only ambient light and environments
    vec3 emission;          // W/(sr m^2)
    vec3 lightmap;          // irradiance / pi, W/(sr m^2)
    bool lightmapped;       // whether the material has a lightmap, which may be black here
    vec3 dielectric_f0;     // KHR_materials_ior, _specular
    float dielectric_f90;
    float transmission;     // fraction of entering light transmitted without diffusion; blended draws
    uint material_id;
    vec2 texcoord;          // forward+ only
    // Tangent frame and texel of a normal map; 0 without one or if its scale is 0. Only for forward+
    // channels.
    vec3 tangent;           // unit, world
    float handedness;       // bitangent = handedness * cross(normal, tangent)
    vec3 tangent_normal;    // unit, tangent space
    vec3 object_irradiance; // forward+ with object_lights: of lights not shaded per pixel, W/m^2
};

// Whether the Surface needs the triangle's normal: for its channel and for shadow bias. (A shading normal
// that may vanish computes it separately.)
bool needsGeometricNormal() {
    return on(feature_captured) || on(feature_shadows) || on(feature_local_shadows);
}

// Specular colour at normal incidence.
vec3 specularF0(Surface s) { return blend(s.dielectric_f0, s.albedo, s.metallic); }

#endif
