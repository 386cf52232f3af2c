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
    // Layers: shared/contract/gbuffer.h.
#define MEMBER(type, name) type name;
#define MEMBERS(layer, packed, values) values(MEMBER)
    STORED_LAYERS(MEMBERS)
    float transmission;     // KHR_materials_transmission: weight; 0: none, and so are its values. Only draws
                            // after opaque surfaces.
    float ior;              // 0: infinite
    float thickness;        // KHR_materials_volume: of a slab, m; 0: a thin wall
    vec3 attenuation_color;      // of white light after attenuation_distance, m; 0: nothing is absorbed
    float attenuation_distance;
    float dispersion;       // KHR_materials_dispersion: 20 / Abbe number
    float coverage;         // with transmission: alpha, 0 to 1
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

bool hasLayer(const uint layer) { return (feature_layers & layer) != 0u; }

// A surface without layers, emission and lightmap. Of the base, normals, albedo, metallic and roughness are
// undefined.
Surface bareSurface(const vec3 position) {
    Surface s;
    s.position = position;
    s.occlusion = 1.0;
    s.emission = s.lightmap = vec3(0.0);
    s.lightmapped = false;
    s.dielectric_f0 = vec3(DEFAULT_DIELECTRIC_F0);
    s.dielectric_f90 = 1.0;
#define REMOVE(type, name) s.name = type(0.0);
#define REMOVE_LAYER(layer, packed, values) values(REMOVE)
    STORED_LAYERS(REMOVE_LAYER)
    s.transmission = s.ior = s.thickness = s.attenuation_distance = s.dispersion = 0.0;
    s.attenuation_color = vec3(0.0);
    s.coverage = 1.0;
    s.material_id = 0u;
    s.texcoord = vec2(0.0);
    s.tangent = s.tangent_normal = s.object_irradiance = vec3(0.0);
    s.handedness = 0.0;
    return s;
}

// Two unit vectors perpendicular to the unit vector `n`, right-handed with it (Duff et al. 2017, "Building
// an Orthonormal Basis, Revisited").
void axesAcross(const vec3 n, out vec3 x, out vec3 y) {
    float sign_z = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (sign_z + n.z), b = n.x * n.y * a;
    x = vec3(1.0 + sign_z * n.x * n.x * a, sign_z * b, -sign_z * n.x);
    y = vec3(b, sign_z + n.y * n.y * a, -n.y);
}

// Unit vector along which highlights stretch, world axes; 0 where isotropic.
vec3 anisotropyDirection(const Surface s) {
    vec3 x, y;
    axesAcross(s.normal, x, y);
    vec3 direction = x * s.anisotropy_turn.x + y * s.anisotropy_turn.y;
    return s.anisotropy > 0.0 ? direction : vec3(0.0);  // never -0
}

// The turn of any vector that is not along `n`; 0 otherwise.
vec2 turnOf(const vec3 direction, const vec3 n) {
    vec3 x, y;
    axesAcross(n, x, y);
    vec2 turn = vec2(dot(direction, x), dot(direction, y));
    float largest = max(abs(turn.x), abs(turn.y));
    return largest > 0.0 ? normalized(turn / largest) : vec2(0.0);
}

// Specular colour at normal incidence.
vec3 specularF0(const Surface s) { return blend(s.dielectric_f0, s.albedo, s.metallic); }

#endif
