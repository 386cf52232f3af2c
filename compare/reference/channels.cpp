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
    Channel mode;
    glm::dvec3 (*value)(const Pixel&);
    glm::vec4 rounding{0};  // weights of Picture::rounding
};
constexpr ChannelRow channelRows[] = {
    // Light is the mean over the pixel's area, even if the centre shows background.
    {Channel::lit, [](const Pixel& p) { return p.lit; }, {1, 1, 0, 0}},
    {Channel::lit_diffuse,
     [](const Pixel& p) { return p.shading.reflected.diffuse + p.shading.reflected.transmitted; },
     {1, 0, 0, 0}},
    {Channel::lit_specular, [](const Pixel& p) { return p.shading.reflected.specular; }, {0, 1, 0, 0}},
    {Channel::lit_ambient, [](const Pixel& p) { return p.shading.ambient; }},
    {Channel::lit_environment, [](const Pixel& p) { return p.shading.environment.sum(); }},
    {Channel::lit_clearcoat, [](const Pixel& p) { return p.shading.clearcoat; }, {0, 0, 1, 0}},
    {Channel::lit_sheen, [](const Pixel& p) { return p.shading.sheen; }, {0, 0, 0, 1}},
    {Channel::lit_transmission, [](const Pixel& p) { return p.transmitted; }},
    {Channel::lit_haze, [](const Pixel& p) { return p.haze.scattered; }},
    {Channel::shadow_visibility, [](const Pixel& p) { return glm::dvec3(p.sun_visibility); }},
    {Channel::local_visibility, [](const Pixel& p) { return glm::dvec3(p.local_visibility); }},

    {Channel::transmission, ofPane<&Surface::transmission>},
    {Channel::transmission_thickness, ofPane<&Surface::thickness>},
    {Channel::attenuation_color, ofPane<&Surface::attenuation_color>},
    {Channel::attenuation_distance, ofPane<&Surface::attenuation_distance>},
    {Channel::dispersion, ofPane<&Surface::dispersion>},

    {Channel::depth, [](const Pixel& p) { return glm::dvec3(p.surface ? p.depth : 0); }},
    {Channel::transmittance, [](const Pixel& p) { return p.surface ? p.haze.transmittance : glm::dvec3(0); }},
    {Channel::specular, [](const Pixel& p) { return p.surface ? specularColor(*p.surface) : glm::dvec3(0); }},
    {Channel::material_id, [](const Pixel& p) { return glm::dvec3(p.surface ? p.surface->material : -1); }},
    {Channel::texcoords,
     [](const Pixel& p) { return p.surface ? glm::dvec3(p.surface->texcoord, 0) : glm::dvec3(0); }},
    {Channel::albedo, ofSurface<&Surface::albedo>},
    {Channel::normals, ofSurface<&Surface::normal>},
    {Channel::metallic, ofSurface<&Surface::metallic>},
    {Channel::roughness, ofSurface<&Surface::roughness>},
    {Channel::emission, ofSurface<&Surface::emission>},
    {Channel::occlusion, ofSurface<&Surface::occlusion>},
    {Channel::position, ofSurface<&Surface::position>},
    {Channel::geometric_normal, ofSurface<&Surface::geometric_normal>},
    {Channel::dielectric_f0, ofSurface<&Surface::dielectric_f0>},
    {Channel::dielectric_f90, ofSurface<&Surface::dielectric_f90>},
    {Channel::lightmap, ofSurface<&Surface::lightmap>},
    {Channel::lightmapped, ofSurface<&Surface::lightmapped>},
    {Channel::tangent, ofSurface<&Surface::tangent>},
    {Channel::handedness, ofSurface<&Surface::handedness>},
    {Channel::tangent_normal, ofSurface<&Surface::tangent_normal>},
    {Channel::clearcoat, ofSurface<&Surface::clearcoat>},
    {Channel::clearcoat_roughness, ofSurface<&Surface::clearcoat_roughness>},
    {Channel::clearcoat_normal, ofSurface<&Surface::clearcoat_normal>},
    {Channel::anisotropy, ofSurface<&Surface::anisotropy>},
    {Channel::anisotropy_direction, ofSurface<&Surface::anisotropy_direction>},
    {Channel::sheen_color, ofSurface<&Surface::sheen_color>},
    {Channel::sheen_roughness, ofSurface<&Surface::sheen_roughness>},
    {Channel::iridescence, ofSurface<&Surface::iridescence>},
    {Channel::iridescence_ior, ofSurface<&Surface::iridescence_ior>},
    {Channel::iridescence_thickness, ofSurface<&Surface::iridescence_thickness>},
    {Channel::diffuse_transmission, ofSurface<&Surface::diffuse_transmission>},
    {Channel::diffuse_transmission_color, ofSurface<&Surface::diffuse_transmission_color>},
};

}  // namespace

double roundingOf(Channel mode, const float* rounding) {
    const auto row = std::ranges::find(channelRows, mode, &ChannelRow::mode);
    if (row == std::end(channelRows)) return 0;
    return double{glm::dot(row->rounding, glm::vec4(rounding[0], rounding[1], rounding[2], rounding[3]))};
}

glm::dvec3 channelValue(Channel mode, const Pixel& pixel) {
    const auto row = std::ranges::find(channelRows, mode, &ChannelRow::mode);
    if (row == std::end(channelRows))
        throw std::logic_error("the reference lacks a channel: " + std::string(debugMode(mode).name));
    return row->value(pixel);
}

Surface Captured::surface(std::size_t pixel, const PixelRays& rays, int material) const {
    Surface s;
    s.position = value(Channel::position, pixel);
    s.to_viewer = rays.toViewer(s.position);
    // A float32 unit vector is off by up to 1e-7, which would affect 1 - (n.h)^2 at a highlight.
    s.normal = unitOr(value(Channel::normals, pixel), s.to_viewer);
    s.geometric_normal = unitOr(value(Channel::geometric_normal, pixel), s.to_viewer);
    s.albedo = value(Channel::albedo, pixel);
    s.metallic = value(Channel::metallic, pixel).x;
    s.roughness = value(Channel::roughness, pixel).x;
    s.occlusion = value(Channel::occlusion, pixel).x;
    s.emission = value(Channel::emission, pixel);
    s.lightmap = value(Channel::lightmap, pixel);
    s.dielectric_f90 = value(Channel::dielectric_f90, pixel).x;
    s.material = material;
    s.lightmapped = hasLightmap(materials_.at(static_cast<std::size_t>(s.material)));
    s.dielectric_f0 = value(Channel::dielectric_f0, pixel);
    if (isCaptured(Channel::clearcoat)) {
        s.clearcoat = value(Channel::clearcoat, pixel).x;
        s.clearcoat_roughness = value(Channel::clearcoat_roughness, pixel).x;
        if (s.clearcoat > 0)
            s.clearcoat_normal = unitOr(value(Channel::clearcoat_normal, pixel), s.to_viewer);
    }
    if (isCaptured(Channel::anisotropy))
        s.stretch(value(Channel::anisotropy, pixel).x, value(Channel::anisotropy_direction, pixel));
    if (isCaptured(Channel::sheen_color)) {
        s.sheen_color = value(Channel::sheen_color, pixel);
        s.sheen_roughness = value(Channel::sheen_roughness, pixel).x;
    }
    if (isCaptured(Channel::iridescence)) {
        s.iridescence = value(Channel::iridescence, pixel).x;
        s.iridescence_ior = value(Channel::iridescence_ior, pixel).x;
        s.iridescence_thickness = value(Channel::iridescence_thickness, pixel).x;
    }
    if (isCaptured(Channel::diffuse_transmission)) {
        s.diffuse_transmission = value(Channel::diffuse_transmission, pixel).x;
        s.diffuse_transmission_color = value(Channel::diffuse_transmission_color, pixel);
    }
    return s;
}

glm::dvec3 Captured::value(Channel mode, std::size_t pixel) const {
    const Image& image = channels_.at(mode);
    const float* p = image.pixel(pixel);
    glm::dvec3 result(0);
    for (int c = 0; c < std::min(image.components, 3); ++c) result[c] = double{p[c]};
    return result;
}

}  // namespace diptych::reference
