// SPDX-License-Identifier: MIT
#include "compare/reference/channels.h"

#include "compare/reference/material.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/model/axes.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace diptych::reference {
namespace {

glm::dvec3 specularColor(const Surface& s) {
    return s.dielectric_f0 * (1 - s.metallic) + s.albedo * s.metallic;
}

}  // namespace

glm::dvec3 channelValue(int mode, const Pixel& pixel) {
    // Light is the mean over the pixel's area, even if the centre shows background.
    switch (static_cast<gpu::uint>(mode)) {
        case gpu::DEBUG_lit:
            return pixel.lit;
        case gpu::DEBUG_lit_diffuse:
            return pixel.shading.reflected.diffuse;
        case gpu::DEBUG_lit_specular:
            return pixel.shading.reflected.specular;
        case gpu::DEBUG_lit_ambient:
            return pixel.shading.ambient;
        case gpu::DEBUG_lit_environment:
            return pixel.shading.environment.diffuse + pixel.shading.environment.specular;
        case gpu::DEBUG_lit_clearcoat:
            return pixel.shading.clearcoat;
        case gpu::DEBUG_lit_sheen:
            return pixel.shading.sheen;
        case gpu::DEBUG_lit_haze:
            return pixel.haze.scattered;
        case gpu::DEBUG_shadow_visibility:
            return glm::dvec3(pixel.sun_visibility);
        case gpu::DEBUG_local_visibility:
            return glm::dvec3(pixel.local_visibility);
        default:
            break;
    }
    if (!pixel.surface) return glm::dvec3(mode == static_cast<int>(gpu::DEBUG_material_id) ? -1 : 0);
    const Surface& s = *pixel.surface;
    switch (static_cast<gpu::uint>(mode)) {
        case gpu::DEBUG_albedo:
            return s.albedo;
        case gpu::DEBUG_normals:
            return s.normal;
        case gpu::DEBUG_metallic:
            return glm::dvec3(s.metallic);
        case gpu::DEBUG_roughness:
            return glm::dvec3(s.roughness);
        case gpu::DEBUG_emission:
            return s.emission;
        case gpu::DEBUG_occlusion:
            return glm::dvec3(s.occlusion);
        case gpu::DEBUG_specular:
            return specularColor(s);
        case gpu::DEBUG_material_id:
            return glm::dvec3(s.material);
        case gpu::DEBUG_texcoords:
            return glm::dvec3(s.texcoord, 0);
        case gpu::DEBUG_depth:
            return glm::dvec3(pixel.depth);
        case gpu::DEBUG_transmittance:
            return pixel.haze.transmittance;
        case gpu::DEBUG_position:
            return s.position;
        case gpu::DEBUG_geometric_normal:
            return s.geometric_normal;
        case gpu::DEBUG_dielectric_f90:
            return glm::dvec3(s.dielectric_f90);
        case gpu::DEBUG_lightmap:
            return s.lightmap;
        case gpu::DEBUG_tangent:
            return s.tangent;
        case gpu::DEBUG_handedness:
            return glm::dvec3(s.handedness);
        case gpu::DEBUG_tangent_normal:
            return s.tangent_normal;
        case gpu::DEBUG_dielectric_f0:
            return s.dielectric_f0;
        case gpu::DEBUG_lightmapped:
            return glm::dvec3(s.lightmapped);
        case gpu::DEBUG_clearcoat:
            return glm::dvec3(s.clearcoat);
        case gpu::DEBUG_clearcoat_roughness:
            return glm::dvec3(s.clearcoat_roughness);
        case gpu::DEBUG_clearcoat_normal:
            return s.clearcoat_normal;
        case gpu::DEBUG_anisotropy:
            return glm::dvec3(s.anisotropy);
        case gpu::DEBUG_anisotropy_direction:
            return s.anisotropy_direction;
        case gpu::DEBUG_sheen_color:
            return s.sheen_color;
        case gpu::DEBUG_sheen_roughness:
            return glm::dvec3(s.sheen_roughness);
        case gpu::DEBUG_iridescence:
            return glm::dvec3(s.iridescence);
        case gpu::DEBUG_iridescence_ior:
            return glm::dvec3(s.iridescence_ior);
        case gpu::DEBUG_iridescence_thickness:
            return glm::dvec3(s.iridescence_thickness);
    }
    throw std::logic_error("the reference lacks a channel: " + std::string(debugMode(mode).name));
}

Surface Captured::surface(std::size_t pixel, const PixelRays& rays, int material) const {
    Surface s;
    s.position = value(gpu::DEBUG_position, pixel);
    s.to_viewer = rays.toViewer(s.position);
    // A float32 unit vector is off by up to 1e-7, which would affect 1 - (n.h)^2 at a highlight.
    s.normal = unitOr(value(gpu::DEBUG_normals, pixel), s.to_viewer);
    s.geometric_normal = unitOr(value(gpu::DEBUG_geometric_normal, pixel), s.to_viewer);
    s.albedo = value(gpu::DEBUG_albedo, pixel);
    s.metallic = value(gpu::DEBUG_metallic, pixel).x;
    s.roughness = value(gpu::DEBUG_roughness, pixel).x;
    s.occlusion = value(gpu::DEBUG_occlusion, pixel).x;
    s.emission = value(gpu::DEBUG_emission, pixel);
    s.lightmap = value(gpu::DEBUG_lightmap, pixel);
    s.dielectric_f90 = value(gpu::DEBUG_dielectric_f90, pixel).x;
    s.material = material;
    s.lightmapped = hasLightmap(materials_.at(static_cast<std::size_t>(s.material)));
    s.dielectric_f0 = value(gpu::DEBUG_dielectric_f0, pixel);
    if (isCaptured(gpu::DEBUG_clearcoat)) {
        s.clearcoat = value(gpu::DEBUG_clearcoat, pixel).x;
        s.clearcoat_roughness = value(gpu::DEBUG_clearcoat_roughness, pixel).x;
        if (s.clearcoat > 0)
            s.clearcoat_normal = unitOr(value(gpu::DEBUG_clearcoat_normal, pixel), s.to_viewer);
    }
    if (isCaptured(gpu::DEBUG_anisotropy))
        s.stretch(value(gpu::DEBUG_anisotropy, pixel).x, value(gpu::DEBUG_anisotropy_direction, pixel));
    if (isCaptured(gpu::DEBUG_sheen_color)) {
        s.sheen_color = value(gpu::DEBUG_sheen_color, pixel);
        s.sheen_roughness = value(gpu::DEBUG_sheen_roughness, pixel).x;
    }
    if (isCaptured(gpu::DEBUG_iridescence)) {
        s.iridescence = value(gpu::DEBUG_iridescence, pixel).x;
        s.iridescence_ior = value(gpu::DEBUG_iridescence_ior, pixel).x;
        s.iridescence_thickness = value(gpu::DEBUG_iridescence_thickness, pixel).x;
    }
    return s;
}

glm::dvec3 Captured::value(gpu::uint mode, std::size_t pixel) const {
    const Image& image = channels_.at(static_cast<int>(mode));
    const float* p = image.pixel(pixel);
    glm::dvec3 result(0);
    for (int c = 0; c < std::min(image.components, 3); ++c) result[c] = double{p[c]};
    return result;
}

}  // namespace diptych::reference
