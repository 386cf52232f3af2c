// SPDX-License-Identifier: MIT
#include "compare/reference/channels.h"

#include "compare/reference/material.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

namespace diptych::reference {
namespace {

glm::dvec3 specularColor(const Surface& s) {
    return s.dielectric_f0 * (1 - s.metallic) + s.albedo * s.metallic;
}

// A number fills all components. 0 in the background.
template <auto member>
glm::dvec3 ofSurface(const Pixel& p) {
    return p.surface ? glm::dvec3((*p.surface).*member) : glm::dvec3(0);
}

// The same of the nearest surface with transmission; 0 without one, or where a texture removes it.
template <auto member>
glm::dvec3 ofPane(const Pixel& p) {
    return p.pane && p.pane->transmission > 0 ? glm::dvec3((*p.pane).*member) : glm::dvec3(0);
}

struct ChannelRow {
    gpu::uint mode;
    glm::dvec3 (*value)(const Pixel&);
    glm::vec4 rounding{0};  // weights of Picture::rounding
};
constexpr ChannelRow channelRows[] = {
    // Light is the mean over the pixel's area, even if the centre shows background.
    {gpu::DEBUG_lit, [](const Pixel& p) { return p.lit; }, {1, 1, 0, 0}},
    {gpu::DEBUG_lit_diffuse,
     [](const Pixel& p) { return p.shading.reflected.diffuse + p.shading.reflected.transmitted; },
     {1, 0, 0, 0}},
    {gpu::DEBUG_lit_specular, [](const Pixel& p) { return p.shading.reflected.specular; }, {0, 1, 0, 0}},
    {gpu::DEBUG_lit_ambient, [](const Pixel& p) { return p.shading.ambient; }},
    {gpu::DEBUG_lit_environment, [](const Pixel& p) { return p.shading.environment.sum(); }},
    {gpu::DEBUG_lit_clearcoat, [](const Pixel& p) { return p.shading.clearcoat; }, {0, 0, 1, 0}},
    {gpu::DEBUG_lit_sheen, [](const Pixel& p) { return p.shading.sheen; }, {0, 0, 0, 1}},
    {gpu::DEBUG_lit_transmission, [](const Pixel& p) { return p.transmitted; }},
    {gpu::DEBUG_lit_haze, [](const Pixel& p) { return p.haze.scattered; }},
    {gpu::DEBUG_shadow_visibility, [](const Pixel& p) { return glm::dvec3(p.sun_visibility); }},
    {gpu::DEBUG_local_visibility, [](const Pixel& p) { return glm::dvec3(p.local_visibility); }},

    {gpu::DEBUG_transmission, ofPane<&Surface::transmission>},
    {gpu::DEBUG_transmission_thickness, ofPane<&Surface::thickness>},
    {gpu::DEBUG_attenuation_color, ofPane<&Surface::attenuation_color>},
    {gpu::DEBUG_attenuation_distance, ofPane<&Surface::attenuation_distance>},
    {gpu::DEBUG_dispersion, ofPane<&Surface::dispersion>},

    {gpu::DEBUG_depth, [](const Pixel& p) { return glm::dvec3(p.surface ? p.depth : 0); }},
    {gpu::DEBUG_transmittance,
     [](const Pixel& p) { return p.surface ? p.haze.transmittance : glm::dvec3(0); }},
    {gpu::DEBUG_specular,
     [](const Pixel& p) { return p.surface ? specularColor(*p.surface) : glm::dvec3(0); }},
    {gpu::DEBUG_material_id, [](const Pixel& p) { return glm::dvec3(p.surface ? p.surface->material : -1); }},
    {gpu::DEBUG_texcoords,
     [](const Pixel& p) { return p.surface ? glm::dvec3(p.surface->texcoord, 0) : glm::dvec3(0); }},
    {gpu::DEBUG_albedo, ofSurface<&Surface::albedo>},
    {gpu::DEBUG_normals, ofSurface<&Surface::normal>},
    {gpu::DEBUG_metallic, ofSurface<&Surface::metallic>},
    {gpu::DEBUG_roughness, ofSurface<&Surface::roughness>},
    {gpu::DEBUG_emission, ofSurface<&Surface::emission>},
    {gpu::DEBUG_occlusion, ofSurface<&Surface::occlusion>},
    {gpu::DEBUG_position, ofSurface<&Surface::position>},
    {gpu::DEBUG_geometric_normal, ofSurface<&Surface::geometric_normal>},
    {gpu::DEBUG_dielectric_f0, ofSurface<&Surface::dielectric_f0>},
    {gpu::DEBUG_dielectric_f90, ofSurface<&Surface::dielectric_f90>},
    {gpu::DEBUG_lightmap, ofSurface<&Surface::lightmap>},
    {gpu::DEBUG_lightmapped, ofSurface<&Surface::lightmapped>},
    {gpu::DEBUG_tangent, ofSurface<&Surface::tangent>},
    {gpu::DEBUG_handedness, ofSurface<&Surface::handedness>},
    {gpu::DEBUG_tangent_normal, ofSurface<&Surface::tangent_normal>},
    {gpu::DEBUG_clearcoat, ofSurface<&Surface::clearcoat>},
    {gpu::DEBUG_clearcoat_roughness, ofSurface<&Surface::clearcoat_roughness>},
    {gpu::DEBUG_clearcoat_normal, ofSurface<&Surface::clearcoat_normal>},
    {gpu::DEBUG_anisotropy, ofSurface<&Surface::anisotropy>},
    {gpu::DEBUG_anisotropy_direction, ofSurface<&Surface::anisotropy_direction>},
    {gpu::DEBUG_sheen_color, ofSurface<&Surface::sheen_color>},
    {gpu::DEBUG_sheen_roughness, ofSurface<&Surface::sheen_roughness>},
    {gpu::DEBUG_iridescence, ofSurface<&Surface::iridescence>},
    {gpu::DEBUG_iridescence_ior, ofSurface<&Surface::iridescence_ior>},
    {gpu::DEBUG_iridescence_thickness, ofSurface<&Surface::iridescence_thickness>},
    {gpu::DEBUG_diffuse_transmission, ofSurface<&Surface::diffuse_transmission>},
    {gpu::DEBUG_diffuse_transmission_color, ofSurface<&Surface::diffuse_transmission_color>},
};

}  // namespace

double roundingOf(int mode, const float* rounding) {
    const auto row = std::ranges::find(channelRows, static_cast<gpu::uint>(mode), &ChannelRow::mode);
    if (row == std::end(channelRows)) return 0;
    return double{glm::dot(row->rounding, glm::vec4(rounding[0], rounding[1], rounding[2], rounding[3]))};
}

glm::dvec3 channelValue(int mode, const Pixel& pixel) {
    const auto row = std::ranges::find(channelRows, static_cast<gpu::uint>(mode), &ChannelRow::mode);
    if (row == std::end(channelRows))
        throw std::logic_error("the reference lacks a channel: " + std::string(debugMode(mode).name));
    return row->value(pixel);
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
    if (isCaptured(gpu::DEBUG_diffuse_transmission)) {
        s.diffuse_transmission = value(gpu::DEBUG_diffuse_transmission, pixel).x;
        s.diffuse_transmission_color = value(gpu::DEBUG_diffuse_transmission_color, pixel);
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
