// SPDX-License-Identifier: MIT
#ifndef DEBUG_GLSL
#define DEBUG_GLSL

#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/lights/light_lists.glsl"
#include "shaders/lib/shading/radiance.glsl"
#include "shaders/lib/shadows/shadow.glsl"

// Value of a channel (shared/contract/debug_mode.h), without a colour map. z: reversed depth. shaded:
// number of Surfaces shaded at the pixel.
vec4 debugValue(const uint mode, const Surface s, const PixelLights lights, const Radiance radiance,
                const float z, const uint shaded) {
    switch (mode) {
        case DEBUG_lit: return vec4(lit(radiance), 1.0);
        case DEBUG_albedo: return vec4(s.albedo, 1.0);
        case DEBUG_normals: return vec4(s.normal, 1.0);
        case DEBUG_metallic: return vec4(s.metallic);
        case DEBUG_roughness: return vec4(s.roughness);
        case DEBUG_emission: return vec4(s.emission, 1.0);
        case DEBUG_occlusion: return vec4(s.occlusion);
        case DEBUG_specular: return vec4(specularF0(s), 1.0);
        case DEBUG_material_id: return vec4(float(s.material_id));
        case DEBUG_texcoords: return vec4(s.texcoord, 0.0, 1.0);
        case DEBUG_depth: return vec4(viewDepth(z));
        case DEBUG_position: return vec4(s.position, 1.0);
        case DEBUG_geometric_normal: return vec4(s.triangle_normal, 1.0);
        case DEBUG_light_count: return vec4(float(lightCount(lights)));
        case DEBUG_list_overflow: return vec4(listOverflowed(lights) ? 1.0 : 0.0);
        case DEBUG_shaded_samples: return vec4(float(shaded));
        case DEBUG_shadow_visibility: return vec4(radiance.sun_visibility);
        case DEBUG_cascade: return vec4(servingCascade(s.position));
        case DEBUG_page_residency: return vec4(pageResidency(s.position));
        case DEBUG_local_visibility: return vec4(localVisibility(radiance));
        case DEBUG_lit_diffuse: return vec4(radiance.diffuse, 1.0);
        case DEBUG_lit_specular: return vec4(radiance.specular, 1.0);
        case DEBUG_lit_ambient: return vec4(radiance.ambient, 1.0);
        case DEBUG_lit_haze: return vec4(radiance.haze, 1.0);
        case DEBUG_transmittance: return vec4(radiance.transmittance, 1.0);
        case DEBUG_lit_environment: return vec4(radiance.environment, 1.0);
        case DEBUG_dielectric_f90: return vec4(s.dielectric_f90);
        case DEBUG_lightmap: return vec4(s.lightmap, 1.0);
        case DEBUG_tangent: return vec4(s.tangent, 1.0);
        case DEBUG_handedness: return vec4(s.handedness);
        case DEBUG_tangent_normal: return vec4(s.tangent_normal, 1.0);
        case DEBUG_lightmapped: return vec4(s.lightmapped ? 1.0 : 0.0);
        case DEBUG_lit_clearcoat: return vec4(radiance.clearcoat, 1.0);
        case DEBUG_lit_sheen: return vec4(radiance.sheen, 1.0);
        case DEBUG_clearcoat: return vec4(s.clearcoat);
        case DEBUG_clearcoat_roughness: return vec4(s.clearcoat_roughness);
        case DEBUG_clearcoat_normal: return vec4(s.clearcoat_normal, 1.0);
        case DEBUG_anisotropy: return vec4(s.anisotropy);
        case DEBUG_anisotropy_direction: return vec4(anisotropyDirection(s), 1.0);
        case DEBUG_sheen_color: return vec4(s.sheen_color, 1.0);
        case DEBUG_sheen_roughness: return vec4(s.sheen_roughness);
        case DEBUG_iridescence: return vec4(s.iridescence);
        case DEBUG_iridescence_ior: return vec4(s.iridescence_ior);
        case DEBUG_iridescence_thickness: return vec4(s.iridescence_thickness);
        case DEBUG_transmission: return vec4(s.transmission);
        case DEBUG_transmission_thickness: return vec4(s.thickness);
        case DEBUG_attenuation_color: return vec4(s.attenuation_color, 1.0);
        case DEBUG_attenuation_distance: return vec4(s.attenuation_distance);
        case DEBUG_dispersion: return vec4(s.dispersion);
        case DEBUG_diffuse_transmission: return vec4(s.diffuse_transmission);
        case DEBUG_diffuse_transmission_color: return vec4(s.diffuse_transmission_color, 1.0);
        case DEBUG_lit_transmission: return vec4(radiance.transmission, 1.0);
        case DEBUG_dielectric_f0: return vec4(s.dielectric_f0, 1.0);
    }
    return vec4(0.0);
}

#endif
