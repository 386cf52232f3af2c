// SPDX-License-Identifier: MIT
// Closed forms of the cells, written solely from the texts of glTF 2.0 and its extensions.
#include "shared/contract/debug_mode.h"
#include "tests/image/material_cells.h"
#include "tests/support/srgb.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych::tests {
namespace {

struct CellSurface {
    glm::dvec3 albedo{0}, normal{0, 0, 1}, emission{0}, f0{0}, lightmap{0};
    bool lightmapped = false;
    glm::dvec3 tangent{0}, tangent_normal{0}, layer_f0{0};
    double metallic = 0, roughness = 1, occlusion = 1, f90 = 0, handedness = 0;
};

std::vector<double> components(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// MikkTSpace: the tangent points along growing u at constant v, the bitangent along falling v at constant
// u. Uses the coordinates that the map is read with, KHR_texture_transform included. Columns: du and dv
// directions on the square, in x and y.
glm::dmat2 growthOf(const CellTexture& map) {
    // d(uv)/d(xy): u grows to the right, v downwards. The second set is the first one transposed.
    const int set = map.transform && map.transform->texcoord ? *map.transform->texcoord : map.texcoord;
    glm::dmat2 uv = set == 1 ? glm::dmat2(0, 1, -1, 0) : glm::dmat2(1, 0, 0, -1);
    if (map.transform) {
        const double c = std::cos(map.transform->rotation), s = std::sin(map.transform->rotation);
        const glm::dvec2& scale = map.transform->scale;
        uv = glm::dmat2(c, -s, s, c) * glm::dmat2(scale.x, 0, 0, scale.y) * uv;
    }
    return glm::inverse(uv);
}

// glTF 2.0, 3.7.2.1 and 3.9.3: (T, w cross(N, T), N), transformed to the world as normals and as
// directions. A mirroring node flips the cross product. Seen from behind the normal is negated.
void mapNormal(const Cell& cell, const glm::dvec3& texel, CellSurface& s) {
    glm::dvec3 tangent(std::cos(cell.tangent_angle), std::sin(cell.tangent_angle), 0);
    double w = cell.tangent_w;
    if (cell.tangents_made) {
        const glm::dmat2 growth = growthOf(cell.textures[gpu::SLOT_normal]);
        tangent = glm::dvec3(glm::normalize(growth[0]), 0);
        w = glm::determinant(glm::dmat2(growth[0], -growth[1])) < 0 ? -1 : 1;
    }
    const glm::dmat3 node = cell.node();
    const glm::dvec3 n = glm::normalize(glm::transpose(glm::inverse(node)) * glm::dvec3(0, 0, 1)),
                     t = glm::normalize(node * tangent);
    const double hand = glm::determinant(node) < 0 ? -w : w;
    const glm::dvec3 scaled = texel * glm::dvec3(cell.normal_scale, cell.normal_scale, 1);
    const glm::dvec3 world =
        glm::normalize(t * scaled.x + glm::cross(n, t) * (hand * scaled.y) + n * scaled.z);
    s.normal = cell.fromBehind() ? -world : world;
    if (cell.normal_scale == 0) return;  // the map has no effect and is not read
    s.tangent = t;
    s.handedness = hand;
    s.tangent_normal = glm::normalize(scaled);
}

// In the square's object space, seen from the front: (0, 0) is the upper left corner.
glm::dvec2 firstTexcoord(const Cell& cell, const glm::dvec2& at) {
    const glm::dmat3 node = cell.node();
    return {node[0][0] > 0 ? at.x : 1 - at.x, node[1][1] > 0 ? at.y : 1 - at.y};
}

}  // namespace

// Normals tilt by 14 to 48 degrees in every direction. Metallic and roughness are never small, so no
// highlight magnifies rounding. Other components of a texel differ by at least 55 codes, texels of an
// image by at least 9. One texel is opaque: 255 is exact on every device, so its products with halves
// equal a cutoff exactly.
glm::ivec4 codesAt(int image, int column, int row) {
    const int texel = 4 * row + column;
    glm::ivec4 codes;
    for (int c = 0; c < 4; ++c) codes[c] = (texel * 53 + c * 67 + image * 29) % 256;
    if (image == gpu::SLOT_base_color && texel == 11) codes.a = 255;
    if (image == gpu::SLOT_metallic_roughness)
        for (int c = 0; c < 4; ++c) codes[c] = 100 + codes[c] * 150 / 255;
    if (image == gpu::SLOT_normal) {
        const double around = texel * 2.4, lean = 0.25 + 0.5 * texel / 15;
        const glm::dvec3 n(std::sin(lean) * std::cos(around), std::sin(lean) * std::sin(around),
                           std::cos(lean));
        for (int c = 0; c < 3; ++c) codes[c] = static_cast<int>(std::lround((n[c] + 1) / 2 * 255));
    }
    return codes;
}

CellDecode exactDecode() {
    return {[](int code) { return decodedSrgb(code / 255.0); }, [](int code) { return code / 255.0; }};
}

// A camera's field of view is the image's height, for any width.
CellPosition cellPosition(const std::vector<Cell>& cells, const CellCamera& camera, const glm::dvec2& pixel) {
    const glm::dvec2 size(camera.size);
    const glm::dvec2 screen = glm::dvec2(pixel.x - size.x / 2, size.y / 2 - pixel.y) / (size.y / 2);
    const glm::dmat3 axes = camera.axes();
    glm::dvec3 origin = camera.eye, direction = -axes[2];
    if (camera.orthographic)
        origin += (axes[0] * screen.x + axes[1] * screen.y) * camera.half;
    else
        direction += (axes[0] * screen.x + axes[1] * screen.y) * (camera.half / camera.eye.z);
    CellPosition place;
    place.depth = -origin.z / direction.z;  // directions have a depth of one metre
    const glm::dvec3 hit = origin + direction * place.depth;
    place.position = hit - camera.eye;
    const glm::dvec2 at(hit.x + cellsAcross / 2, cellsAcross / 2 - hit.y), cell = glm::floor(at);
    const int column = static_cast<int>(cell.x), row = static_cast<int>(cell.y);
    const int number = row * cellsAcross + column;
    const bool inside =
        column >= 0 && column < cellsAcross && row >= 0 && number < static_cast<int>(cells.size());
    place.cell = inside ? number : -1;
    place.at = at - cell;
    return place;
}

// KHR_texture_transform: scale, then rotate counter-clockwise as the image shows it (v grows downwards),
// then translate. Repeats beyond the image.
glm::ivec2 texelAt(const Cell& cell, std::size_t slot, const glm::dvec2& at) {
    const CellTexture& use = cell.textures[slot];
    const glm::dvec2 first = firstTexcoord(cell, at);
    const int set = use.transform && use.transform->texcoord ? *use.transform->texcoord : use.texcoord;
    glm::dvec2 uv = set == 1 ? glm::dvec2(first.y, first.x) : first;
    if (use.transform) {
        uv *= use.transform->scale;
        const double c = std::cos(use.transform->rotation), s = std::sin(use.transform->rotation);
        uv = glm::dvec2(uv.x * c + uv.y * s, uv.y * c - uv.x * s) + use.transform->offset;
    }
    const glm::dvec2 texel = glm::floor((uv - glm::floor(uv)) * 4.0);
    return glm::min(glm::ivec2(texel), glm::ivec2(3));
}

std::optional<std::map<Channel, std::vector<double>>> cellValues(const Cell& cell, const CellPosition& place,
                                                                 const CellDecode& decode) {
    const auto texel = [&](std::size_t slot, bool srgb) {
        const int image = cell.textures[slot].image;
        glm::dvec4 value(1);
        if (image < 0) return value;
        const glm::ivec2 at = texelAt(cell, slot, place.at);
        const glm::ivec4 codes = codesAt(image, at.x, at.y);
        for (int c = 0; c < 4; ++c)
            value[c] = srgb && c < 3 ? decode.srgb(codes[c]) : decode.linear(codes[c]);
        return value;
    };
    const glm::dvec4 color = cell.base_color * texel(gpu::SLOT_base_color, true) *
                             (cell.colors == CellColors::none ? glm::dvec4(1) : cell.color);
    // Compared as floats, so that a cutoff written from a texel's alpha equals it.
    if (cell.masked && static_cast<float>(color.a) < static_cast<float>(cell.alpha_cutoff.value_or(0.5)))
        return std::nullopt;
    if (cell.fromBehind() && !cell.double_sided) return std::nullopt;

    CellSurface s;
    s.albedo = glm::dvec3(color);
    if (cell.unlit) {
        s.emission = s.albedo;
        s.albedo = glm::dvec3(0);
    } else {
        const glm::dvec4 orm = texel(gpu::SLOT_metallic_roughness, false);
        s.metallic = cell.metallic * orm.b;
        s.roughness = cell.roughness * orm.g;
        if (cell.textures[gpu::SLOT_normal].image >= 0)
            mapNormal(cell, glm::dvec3(texel(gpu::SLOT_normal, false)) * 2.0 - 1.0, s);
        s.occlusion = 1 + cell.occlusion_strength * (texel(gpu::SLOT_occlusion, false).r - 1);
        if (cell.textures[gpu::SLOT_occlusion].image < 0) s.occlusion = 1;
        s.emission =
            cell.emissive * cell.emissive_strength.value_or(1) * glm::dvec3(texel(gpu::SLOT_emissive, true));
        s.lightmapped = cell.textures[gpu::SLOT_lightmap].image >= 0;
        if (s.lightmapped) s.lightmap = cell.lightmap_intensity * glm::dvec3(texel(gpu::SLOT_lightmap, true));
        const double ior = cell.ior.value_or(1.5);
        const double r = ior == 0 ? 1 : (ior - 1) / (ior + 1);
        s.f90 = cell.specular * texel(gpu::SLOT_specular, false).a;
        const glm::dvec3 tint = cell.specular_color * glm::dvec3(texel(gpu::SLOT_specular_color, true));
        s.layer_f0 = glm::min(r * r * tint, glm::dvec3(1)) * s.f90;
        if (cell.specular_glossiness) {
            s.metallic = 0;
            s.f90 = 1;
            s.layer_f0 = tint;
            s.roughness = 1 - (1 - cell.roughness) * texel(gpu::SLOT_specular_color, true).a;
            s.albedo *= 1 - std::max({tint.r, tint.g, tint.b});
        }
        s.f0 = glm::mix(s.layer_f0, s.albedo, s.metallic);
    }
    const glm::dvec2 texcoord = firstTexcoord(cell, place.at);
    const std::pair<Channel, std::vector<double>> values[] = {
        {Channel::albedo, components(s.albedo)},
        {Channel::normals, components(s.normal)},
        {Channel::metallic, {s.metallic}},
        {Channel::roughness, {s.roughness}},
        {Channel::emission, components(s.emission)},
        {Channel::occlusion, {s.occlusion}},
        {Channel::specular, components(s.f0)},
        {Channel::material_id, {static_cast<double>(place.cell)}},
        {Channel::texcoords, {texcoord.x, texcoord.y}},
        {Channel::depth, {place.depth}},
        {Channel::position, components(place.position)},
        {Channel::geometric_normal, {0, 0, 1}},
        {Channel::dielectric_f90, {s.f90}},
        {Channel::lightmap, components(s.lightmap)},
        {Channel::tangent, components(s.tangent)},
        {Channel::handedness, {s.handedness}},
        {Channel::tangent_normal, components(s.tangent_normal)},
        {Channel::dielectric_f0, components(s.layer_f0)},
        {Channel::lightmapped, {s.lightmapped ? 1.0 : 0.0}},
    };
    std::map<Channel, std::vector<double>> byChannel;
    for (const auto& [mode, value] : values) byChannel[mode] = value;
    return byChannel;
}

}  // namespace diptych::tests
