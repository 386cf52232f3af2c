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
    float clearcoat;        // KHR_materials_clearcoat: weight of the layer; 0: none, and so are its values
    float clearcoat_roughness;  // perceptual
    vec3 clearcoat_normal;      // unit, shading
    float anisotropy;       // KHR_materials_anisotropy: strength; 0: isotropic, without a direction
    vec2 anisotropy_turn;   // where highlights stretch: cosine and sine about `normal`, from axesAcross()
    vec3 sheen_color;       // KHR_materials_sheen, linear Rec.709; 0: none, and so is its roughness
    float sheen_roughness;  // perceptual
    float iridescence;      // KHR_materials_iridescence: weight of the film; 0: none, and so are its values
    float iridescence_ior;
    float iridescence_thickness;  // nm
    float diffuse_transmission;  // KHR_materials_diffuse_transmission: weight; 0: none, and so is its colour
    vec3 diffuse_transmission_color;  // linear Rec.709
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

void removeLayers(inout Surface s) {
    s.clearcoat = s.clearcoat_roughness = s.anisotropy = 0.0;
    s.clearcoat_normal = vec3(0.0);
    s.anisotropy_turn = vec2(0.0);
    s.sheen_color = vec3(0.0);
    s.sheen_roughness = s.iridescence = s.iridescence_ior = s.iridescence_thickness = 0.0;
    s.transmission = s.ior = s.thickness = s.attenuation_distance = s.dispersion = 0.0;
    s.attenuation_color = s.diffuse_transmission_color = vec3(0.0);
    s.diffuse_transmission = 0.0;
    s.coverage = 1.0;
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
