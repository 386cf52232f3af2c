// SPDX-License-Identifier: MIT
// What shading knows of a point. forward+ makes it from the material (material.glsl), deferred lighting from
// the G-buffer (gbuffer.glsl). All later code is shared.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL

#include "shaders/lib/contract.glsl"

struct Surface {
    vec3 position;          // world axes, camera as origin, m
    vec3 normal;            // unit, shading
    vec3 geometric_normal;  // unit, of the triangle, towards the viewer; where shadows begin
    vec3 triangle_normal;   // the same before forward+ quantises it; for the channel alone
    vec3 albedo;            // base colour, linear Rec.709
    float metallic;
    float roughness;        // perceptual
    float occlusion;        // 1: open; for light from everywhere alone
    vec3 emission;          // W/(sr m^2)
    vec3 lightmap;          // irradiance / pi, W/(sr m^2)
    bool lightmapped;       // whether the material has a lightmap, which may be black here
    vec3 dielectric_f0;     // KHR_materials_ior, _specular
    float dielectric_f90;
    float transmission;     // share of what enters that leaves behind, not as diffuse light; blended draws
    uint material_id;
    vec2 texcoord;          // forward+ only
    // What a normal map is read with and holds; 0 without one or where its scale is 0. For channels alone,
    // forward+ only.
    vec3 tangent;           // unit, world
    float handedness;       // bitangent = handedness * cross(normal, tangent)
    vec3 tangent_normal;    // unit, tangent space
    vec3 object_irradiance; // forward+ with object_lights: of those that are not shaded per pixel, W/m^2
};

// Whether the triangle's own normal is carried: as a channel, and where shadows begin. (Making a shading
// normal that may vanish needs it too.)
bool needsGeometricNormal() {
    return on(feature_captured) || on(feature_shadows) || on(feature_local_shadows);
}

// Specular colour at normal incidence.
vec3 specularF0(Surface s) { return blend(s.dielectric_f0, s.albedo, s.metallic); }

#endif
