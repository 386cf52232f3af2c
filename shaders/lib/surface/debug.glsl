// SPDX-License-Identifier: MIT
#ifndef DEBUG_GLSL
#define DEBUG_GLSL

#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/lights/light_lists.glsl"
#include "shaders/lib/shading/radiance.glsl"
#include "shaders/lib/shadows/shadow.glsl"

// VALUE_name: a channel's value (shared/contract/debug_mode.h), without a colour map, of a Surface `s`, its
// `lights` and its `radiance`. `z`: reversed depth. `shaded`: number of Surfaces shaded at the pixel.
#define VALUE_lit vec4(lit(radiance), 1.0)
#define VALUE_albedo vec4(s.albedo, 1.0)
#define VALUE_normals vec4(s.normal, 1.0)
#define VALUE_metallic vec4(s.metallic)
#define VALUE_roughness vec4(s.roughness)
#define VALUE_emission vec4(s.emission, 1.0)
#define VALUE_occlusion vec4(s.occlusion)
#define VALUE_specular vec4(specularF0(s), 1.0)
#define VALUE_material_id vec4(float(s.material_id))
#define VALUE_texcoords vec4(s.texcoord, 0.0, 1.0)
#define VALUE_depth vec4(viewDepth(z))
#define VALUE_position vec4(s.position, 1.0)
#define VALUE_geometric_normal vec4(s.triangle_normal, 1.0)
#define VALUE_light_count vec4(float(lightCount(lights)))
#define VALUE_list_overflow vec4(listOverflowed(lights) ? 1.0 : 0.0)
#define VALUE_shaded_samples vec4(float(shaded))
#define VALUE_shadow_visibility vec4(radiance.sun_visibility)
#define VALUE_cascade vec4(servingCascade(s.position))
#define VALUE_page_residency vec4(pageResidency(s.position))
#define VALUE_local_visibility vec4(localVisibility(radiance))
#define VALUE_lit_diffuse vec4(radiance.diffuse, 1.0)
#define VALUE_lit_specular vec4(radiance.specular, 1.0)
#define VALUE_lit_ambient vec4(radiance.ambient, 1.0)
#define VALUE_lit_haze vec4(radiance.haze, 1.0)
#define VALUE_transmittance vec4(radiance.transmittance, 1.0)
#define VALUE_lit_environment vec4(radiance.environment, 1.0)
#define VALUE_dielectric_f90 vec4(s.dielectric_f90)
#define VALUE_lightmap vec4(s.lightmap, 1.0)
#define VALUE_tangent vec4(s.tangent, 1.0)
#define VALUE_handedness vec4(s.handedness)
#define VALUE_tangent_normal vec4(s.tangent_normal, 1.0)
#define VALUE_lightmapped vec4(s.lightmapped ? 1.0 : 0.0)
#define VALUE_lit_clearcoat vec4(radiance.clearcoat, 1.0)
#define VALUE_lit_sheen vec4(radiance.sheen, 1.0)
#define VALUE_clearcoat vec4(s.clearcoat)
#define VALUE_clearcoat_roughness vec4(s.clearcoat_roughness)
#define VALUE_clearcoat_normal vec4(s.clearcoat_normal, 1.0)
#define VALUE_anisotropy vec4(s.anisotropy)
#define VALUE_anisotropy_direction vec4(anisotropyDirection(s), 1.0)
#define VALUE_sheen_color vec4(s.sheen_color, 1.0)
#define VALUE_sheen_roughness vec4(s.sheen_roughness)
#define VALUE_iridescence vec4(s.iridescence)
#define VALUE_iridescence_ior vec4(s.iridescence_ior)
#define VALUE_iridescence_thickness vec4(s.iridescence_thickness)
#define VALUE_transmission vec4(s.transmission)
#define VALUE_transmission_thickness vec4(s.thickness)
#define VALUE_attenuation_color vec4(s.attenuation_color, 1.0)
#define VALUE_attenuation_distance vec4(s.attenuation_distance)
#define VALUE_dispersion vec4(s.dispersion)
#define VALUE_diffuse_transmission vec4(s.diffuse_transmission)
#define VALUE_diffuse_transmission_color vec4(s.diffuse_transmission_color, 1.0)
#define VALUE_lit_transmission vec4(radiance.transmission, 1.0)
#define VALUE_dielectric_f0 vec4(s.dielectric_f0, 1.0)

#endif
