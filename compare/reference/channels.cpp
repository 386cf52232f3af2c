// SPDX-License-Identifier: MIT
#include "compare/reference/channels.h"

#include "compare/reference/scene/material.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <type_traits>

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
    glm::vec4 rounding{0};                                // weights of ReferenceImage::rounding
    void (*read)(Surface&, const glm::dvec3&) = nullptr;  // from a captured value; null: not needed
};

template <auto member>
void readNumber(Surface& s, const glm::dvec3& value) {
    if constexpr (std::is_same_v<decltype(s.*member), double&>)
        s.*member = value.x;
    else
        s.*member = value;
}
// A float32 unit vector is off by up to 1e-7, which would affect 1 - (n.h)^2 at a highlight.
template <auto member>
void readDirection(Surface& s, const glm::dvec3& value) {
    s.*member = unitOr(value, s.to_viewer);
}

// A member of the surface that shading needs; of a layer it keeps its default if that is not captured.
template <auto member>
constexpr ChannelRow ofShading(Channel mode, void (*read)(Surface&, const glm::dvec3&) = readNumber<member>) {
    return {mode, ofSurface<member>, {}, read};
}

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
    ofShading<&Surface::albedo>(Channel::albedo),
    ofShading<&Surface::normal>(Channel::normals, readDirection<&Surface::normal>),
    ofShading<&Surface::metallic>(Channel::metallic),
    ofShading<&Surface::roughness>(Channel::roughness),
    ofShading<&Surface::emission>(Channel::emission),
    ofShading<&Surface::occlusion>(Channel::occlusion),
    {Channel::position, ofSurface<&Surface::position>},
    ofShading<&Surface::geometric_normal>(Channel::geometric_normal,
                                          readDirection<&Surface::geometric_normal>),
    ofShading<&Surface::dielectric_f0>(Channel::dielectric_f0),
    ofShading<&Surface::dielectric_f90>(Channel::dielectric_f90),
    ofShading<&Surface::lightmap>(Channel::lightmap),
    {Channel::lightmapped, ofSurface<&Surface::lightmapped>},
    {Channel::tangent, ofSurface<&Surface::tangent>},
    {Channel::handedness, ofSurface<&Surface::handedness>},
    {Channel::tangent_normal, ofSurface<&Surface::tangent_normal>},
    ofShading<&Surface::clearcoat>(Channel::clearcoat),
    ofShading<&Surface::clearcoat_roughness>(Channel::clearcoat_roughness),
    ofShading<&Surface::clearcoat_normal>(Channel::clearcoat_normal,
                                          readDirection<&Surface::clearcoat_normal>),
    {Channel::anisotropy, ofSurface<&Surface::anisotropy>},
    {Channel::anisotropy_direction, ofSurface<&Surface::anisotropy_direction>},
    ofShading<&Surface::sheen_color>(Channel::sheen_color),
    ofShading<&Surface::sheen_roughness>(Channel::sheen_roughness),
    ofShading<&Surface::iridescence>(Channel::iridescence),
    ofShading<&Surface::iridescence_ior>(Channel::iridescence_ior),
    ofShading<&Surface::iridescence_thickness>(Channel::iridescence_thickness),
    ofShading<&Surface::diffuse_transmission>(Channel::diffuse_transmission),
    ofShading<&Surface::diffuse_transmission_color>(Channel::diffuse_transmission_color),
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
    s.material = material;
    s.lightmapped = hasLightmap(materials_.at(static_cast<std::size_t>(s.material)));
    for (const ChannelRow& row : channelRows)
        if (row.read && (layerOf(row.mode) == 0 || isCaptured(row.mode))) row.read(s, value(row.mode, pixel));
    if (!(s.clearcoat > 0)) s.clearcoat_normal = glm::dvec3(0);
    if (isCaptured(Channel::anisotropy))
        s.stretch(value(Channel::anisotropy, pixel).x, value(Channel::anisotropy_direction, pixel));
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
