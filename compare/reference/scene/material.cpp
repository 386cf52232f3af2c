// SPDX-License-Identifier: MIT
#include "compare/reference/scene/material.h"

#include "compare/reference/scattering/sheen.h"
#include "compare/reference/scattering/transmission.h"
#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/tangents.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace diptych::reference {
namespace {

// Interpolates values of the triangle's corners by barycentric coordinates.
template <class T>
T mixed(const std::array<T, 3>& corner, const glm::dvec2& b) {
    return corner[0] * (1 - b.x - b.y) + corner[1] * b.x + corner[2] * b.y;
}

glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0);
}

// glTF 2.0, 3.9.4: alpha of at least the cutoff is opaque. The float cutoff may be a texel's alpha rounded
// up, as 0.5019608 is for 128 / 255, so alpha is rounded too.
bool isCutOut(const Material& m, double alpha) {
    return static_cast<float>(alpha) < m.alpha_cutoff;
}

// The unit normal on the side of the ray; the triangle's for a vector of length 0.
glm::dvec3 facing(const Hit& hit, const glm::dvec3& n, const Surface& s) {
    const double length = glm::length(n);
    return !(length > 0) ? s.geometric_normal : hit.front ? n / length : -n / length;
}

}  // namespace

const Material& Materials::material(const Hit& hit) const {
    return materials_[static_cast<std::size_t>(geometry_.primitive(hit.id).material)];
}

// The neighbouring rays intersect the triangle's plane (Igehy 1999, "Tracing Ray Differentials"); to first
// order, t changes by -n.(o' + t d') / n.d.
Footprint Materials::footprint(const Hit& hit, const TextureSlot& slot, const PixelRay* ray) const {
    const auto set = geometry_.texcoords(hit.id, slot.texcoord == 1 ? 1 : 0);
    if (!set) return {{slot.u.z, slot.v.z}};
    const auto moved = [&](const glm::dvec2& uv) {
        return glm::dvec2(glm::dot(slot.u, glm::dvec3(uv, 1)), glm::dot(slot.v, glm::dvec3(uv, 1)));
    };
    const std::array<glm::dvec2, 3> uv{moved((*set)[0]), moved((*set)[1]), moved((*set)[2])};
    Footprint result{mixed(uv, hit.barycentric)};
    if (!ray) return result;
    const std::array<glm::dvec3, 3> p = geometry_.corners(hit.id);
    const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0], normal = glm::cross(a, b);
    const double square = glm::dot(normal, normal);
    const auto change = [&](const glm::dvec3& origin, const glm::dvec3& direction) {
        const glm::dvec3 across = origin + hit.t * direction;
        const glm::dvec3 d =
            across - ray->direction * (glm::dot(normal, across) / glm::dot(normal, ray->direction));
        const double second = glm::dot(glm::cross(d, b), normal) / square;
        const double third = glm::dot(glm::cross(a, d), normal) / square;
        return (uv[1] - uv[0]) * second + (uv[2] - uv[0]) * third;
    };
    result.dx = change(ray->origin_dx, ray->direction_dx);
    result.dy = change(ray->origin_dy, ray->direction_dy);
    return result;
}

template <TextureSlot Material::*texture>
glm::dvec4 Materials::lookUp(const Material& m, const Hit& hit, const PixelRay* ray) const {
    constexpr bool srgb = std::ranges::find(materialSlots, texture, &MaterialSlot::texture)->srgb;
    const TextureSlot& slot = m.*texture;
    if (slot.texture < 0) return glm::dvec4(1);
    return textures_(scene_.textures[static_cast<std::size_t>(slot.texture)], srgb,
                     footprint(hit, slot, ray));
}

glm::dvec4 Materials::baseColor(const Hit& hit, const PixelRay* ray) const {
    const Material& m = material(hit);
    glm::dvec4 color = glm::dvec4(m.base_color) * lookUp<&Material::base_color_texture>(m, hit, ray);
    if (const auto colors = geometry_.colors(hit.id)) color *= mixed(*colors, hit.barycentric);
    return color;
}

bool Materials::isThere(const Hit& hit, const PixelRay* ray) const {
    const Material& m = material(hit);
    if (!hit.front && !m.double_sided) return false;
    return m.alpha_mode != AlphaMode::mask || !isCutOut(m, baseColor(hit, ray).a);
}

bool Materials::throwsShadow(const Hit& hit) const {
    const Material& m = material(hit);
    if (isSeenThrough(m)) return false;
    return !isHole(hit);
}

bool Materials::blends(const Hit& hit) const {
    return isSeenThrough(material(hit));
}

bool Materials::transmits(const Hit& hit) const {
    return letsThrough(material(hit));
}

bool Materials::isThick(const Hit& hit) const {
    return material(hit).thickness > 0;
}

bool Materials::isHole(const Hit& hit) const {
    const Material& m = material(hit);
    return m.alpha_mode == AlphaMode::mask && isCutOut(m, baseColor(hit, nullptr).a);
}

double Materials::coverage(const Hit& hit, const PixelRay& ray) const {
    if (material(hit).alpha_mode != AlphaMode::blend) return 1;
    return std::clamp(baseColor(hit, &ray).a, 0.0, 1.0);
}

// glTF 2.0, 3.7.2.1: normals transform by the inverse transpose, tangents like the surface. Both are
// interpolated without normalisation, as MikkTSpace requires.
Materials::Frame Materials::frameAt(const Hit& hit) const {
    const Primitive& primitive = geometry_.primitive(hit.id);
    const glm::dmat3 world(geometry_.instance(hit.id).world_from_object);
    // The cofactor matrix is the inverse transpose times the determinant; it exists for singular matrices
    // too.
    const double handedness = glm::determinant(world) < 0 ? -1 : 1;
    const glm::dmat3 cofactors = glm::dmat3(glm::cross(world[1], world[2]), glm::cross(world[2], world[0]),
                                            glm::cross(world[0], world[1])) *
                                 handedness;
    const std::array<std::uint32_t, 3> v = geometry_.vertices(hit.id);
    const PosedVertices* posed = geometry_.posed(hit.id);
    const auto normalAt = [&](std::uint32_t i) {
        return posed ? posed->normals[i] : unitOrZero(cofactors * glm::dvec3(primitive.normals[i]));
    };
    const auto tangentAt = [&](std::uint32_t i) {
        return posed ? posed->tangents[i] : unitOrZero(world * glm::dvec3(primitive.tangents[i]));
    };
    const double mirrored = posed ? posed->bitangents : 1,
                 sign = handedness * double{signOf(primitive.tangents[v[0]].w)} * mirrored;
    Frame frame{mixed<glm::dvec3>({normalAt(v[0]), normalAt(v[1]), normalAt(v[2])}, hit.barycentric),
                mixed<glm::dvec3>({tangentAt(v[0]), tangentAt(v[1]), tangentAt(v[2])}, hit.barycentric),
                sign};
    if (rotatedMaps(material(hit), material(hit).anisotropy > 0).layers == 0) return frame;
    const auto rotationAt = [&](std::uint32_t i) {
        const TangentRotation rotation = TangentRotation::of(primitive.tangents[i].w);
        const glm::dvec2 own(rotation.cosine, rotation.sine);
        if (posed) return own;
        // A node's scales change angles within the surface.
        const glm::dvec3 n(primitive.normals[i]), t(primitive.tangents[i]);
        const glm::dvec3 b = glm::cross(n, t) * double{signOf(primitive.tangents[i].w)},
                         along = unitOrZero(world * (t * own.x + b * own.y));
        return glm::dvec2(glm::dot(along, tangentAt(i)),
                          glm::dot(along, sign * glm::cross(normalAt(i), tangentAt(i))));
    };
    frame.rotation =
        mixed<glm::dvec2>({rotationAt(v[0]), rotationAt(v[1]), rotationAt(v[2])}, hit.barycentric);
    frame.mirrored = TangentRotation::of(primitive.tangents[v[0]].w).mirrored;
    return frame;
}

glm::dvec3 Materials::worldOf(const Material& m, const Frame& frame, bool (RotatedMaps::*of)() const,
                              const glm::dvec3& t) {
    const RotatedMaps rotated = rotatedMaps(m, m.anisotropy > 0);
    return (rotated.*of)() ? frame.rotatedWorld(t) : frame.world(t);
}

template <TextureSlot Material::*texture>
glm::dvec3 Materials::mapped(const Material& m, const Hit& hit, float scale, const PixelRay& ray) const {
    const glm::dvec3 t = glm::dvec3(lookUp<texture>(m, hit, &ray)) * 2.0 - 1.0;
    return t * glm::dvec3(double{scale}, double{scale}, 1);
}

// glTF 2.0, 3.9.3; on a back face the normal is flipped.
void Materials::shadeNormal(const Hit& hit, const PixelRay& ray, const Frame& frame, Surface& s) const {
    const Material& m = material(hit);
    glm::dvec3 n = frame.normal;
    if (!m.unlit && m.normal_texture.texture >= 0) {
        const glm::dvec3 t = mapped<&Material::normal_texture>(m, hit, m.normal_scale, ray);
        n = frame.world(t);
        if (m.normal_scale != 0) {  // a scale of 0 disables the map: the paths do not read it
            s.tangent = unitOrZero(frame.tangent);
            s.handedness = frame.sign;
            s.tangent_normal = unitOrZero(t);
        }
    }
    s.normal = facing(hit, n, s);
}

// KHR_materials_clearcoat: strength from red, roughness from green; the base's normal map does not apply.
void Materials::coat(const Hit& hit, const PixelRay& ray, const Frame& frame, Surface& s) const {
    const Material& m = material(hit);
    s.clearcoat = double{m.clearcoat} * lookUp<&Material::clearcoat_texture>(m, hit, &ray).r;
    if (!(s.clearcoat > 0)) return;
    s.clearcoat_roughness =
        double{m.clearcoat_roughness} * lookUp<&Material::clearcoat_roughness_texture>(m, hit, &ray).g;
    const bool has_map = m.clearcoat_normal_texture.texture >= 0 && m.clearcoat_normal_scale != 0;
    const glm::dvec3 n =
        has_map ? worldOf(m, frame, &RotatedMaps::ofCoat,
                          mapped<&Material::clearcoat_normal_texture>(m, hit, m.clearcoat_normal_scale, ray))
                : frame.normal;
    s.clearcoat_normal = facing(hit, n, s);
}

// KHR_materials_anisotropy: direction from red and green, strength from blue.
void Materials::stretch(const Hit& hit, const PixelRay& ray, const Frame& frame, Surface& s) const {
    const Material& m = material(hit);
    glm::dvec2 direction(1, 0);
    double strength = double{m.anisotropy};
    if (m.anisotropy_texture.texture >= 0) {
        const glm::dvec3 texel(lookUp<&Material::anisotropy_texture>(m, hit, &ray));
        direction = glm::dvec2(texel) * 2.0 - 1.0;
        strength *= texel.b;
    }
    const double cosine = std::cos(double{m.anisotropy_rotation}),
                 sine = std::sin(double{m.anisotropy_rotation});
    const glm::dvec3 rotated(cosine * direction.x - sine * direction.y,
                             sine * direction.x + cosine * direction.y, 0);
    s.stretch(strength, worldOf(m, frame, &RotatedMaps::ofAnisotropy, rotated));
}

// KHR_materials_sheen: colour from RGB, roughness from alpha.
void Materials::sheen(const Hit& hit, const PixelRay& ray, Surface& s) const {
    const Material& m = material(hit);
    s.sheen_color =
        glm::dvec3(m.sheen_color) * glm::dvec3(lookUp<&Material::sheen_color_texture>(m, hit, &ray));
    if (!hasSheen(s)) return;
    s.sheen_roughness =
        double{m.sheen_roughness} * lookUp<&Material::sheen_roughness_texture>(m, hit, &ray).a;
}

// KHR_materials_iridescence: weight from red, thickness from green.
void Materials::film(const Hit& hit, const PixelRay& ray, Surface& s) const {
    const Material& m = material(hit);
    s.iridescence = double{m.iridescence} * lookUp<&Material::iridescence_texture>(m, hit, &ray).r;
    if (!(s.iridescence > 0)) return;
    s.iridescence_ior = double{m.iridescence_ior};
    s.iridescence_thickness =
        glm::mix(double{m.iridescence_thickness_min}, double{m.iridescence_thickness_max},
                 lookUp<&Material::iridescence_thickness_texture>(m, hit, &ray).g);
}

// KHR_materials_volume: thickness from green, in the mesh's space; its node scales it, except that a skin
// places the vertices in the world.
double Materials::thicknessAt(const Hit& hit, const PixelRay& ray) const {
    const Material& m = material(hit);
    const Instance& instance = geometry_.instance(hit.id);
    const double scale = instance.skin >= 0
                             ? 1
                             : std::cbrt(std::abs(glm::determinant(glm::dmat3(instance.world_from_object))));
    return double{m.thickness} * lookUp<&Material::thickness_texture>(m, hit, &ray).g * scale;
}

// KHR_materials_transmission: fraction from red.
void Materials::transmit(const Hit& hit, const PixelRay& ray, Surface& s) const {
    const Material& m = material(hit);
    s.transmission = double{m.transmission} * lookUp<&Material::transmission_texture>(m, hit, &ray).r;
    s.ior = double{m.ior};
    s.thickness = thicknessAt(hit, ray);
    s.attenuation_color = glm::dvec3(m.attenuation_color);
    s.attenuation_distance = double{m.attenuation_distance};
    s.dispersion = double{m.dispersion};
}

// KHR_materials_diffuse_transmission: weight from alpha, colour from RGB. A volume absorbs over its
// thickness.
void Materials::transmitDiffusely(const Hit& hit, const PixelRay& ray, Surface& s) const {
    const Material& m = material(hit);
    s.diffuse_transmission =
        double{m.diffuse_transmission} * lookUp<&Material::diffuse_transmission_texture>(m, hit, &ray).a;
    if (!(s.diffuse_transmission > 0)) return;
    Surface volume;
    volume.attenuation_color = glm::dvec3(m.attenuation_color);
    volume.attenuation_distance = double{m.attenuation_distance};
    s.diffuse_transmission_color =
        glm::dvec3(m.diffuse_transmission_color) *
        glm::dvec3(lookUp<&Material::diffuse_transmission_color_texture>(m, hit, &ray)) *
        attenuationOf(volume, thicknessAt(hit, ray));
}

Surface Materials::surface(const Hit& hit, const PixelRay& ray) const {
    const Material& m = material(hit);
    Surface s;
    s.position = hit.position;
    s.geometric_normal =
        glm::dot(hit.geometric_normal, ray.direction) > 0 ? -hit.geometric_normal : hit.geometric_normal;
    const Frame frame = frameAt(hit);
    shadeNormal(hit, ray, frame, s);
    s.material = geometry_.primitive(hit.id).material;
    s.texcoord = footprint(hit, TextureSlot{}, nullptr).uv;
    const glm::dvec3 color(baseColor(hit, &ray));
    if (m.unlit) {  // reflects nothing and emits its base colour
        s.emission = color;
        s.dielectric_f90 = 0;
        return s;
    }
    s.albedo = color;
    const glm::dvec4 metallic_roughness = lookUp<&Material::metallic_roughness_texture>(m, hit, &ray);
    s.roughness = double{m.roughness} * metallic_roughness.g;
    s.metallic = double{m.metallic} * metallic_roughness.b;
    s.occlusion =
        1 + double{m.occlusion_strength} * (lookUp<&Material::occlusion_texture>(m, hit, &ray).r - 1);
    s.emission = glm::dvec3(m.emissive) * glm::dvec3(lookUp<&Material::emissive_texture>(m, hit, &ray));
    // Irradiance over pi.
    s.lightmapped = hasLightmap(m);
    if (s.lightmapped)
        s.lightmap =
            glm::dvec3(lookUp<&Material::lightmap_texture>(m, hit, &ray)) * double{m.lightmap_intensity};
    reflect(hit, ray, s);
    if (letsThrough(m)) transmit(hit, ray, s);
    if (m.diffuse_transmission > 0) transmitDiffusely(hit, ray, s);
    if (m.clearcoat > 0) coat(hit, ray, frame, s);
    if (m.anisotropy > 0) stretch(hit, ray, frame, s);
    if (m.sheen_color != glm::vec3(0)) sheen(hit, ray, s);
    if (m.iridescence > 0) film(hit, ray, s);
    return s;
}

// KHR_materials_ior: 0 means an infinite index. KHR_materials_specular: colour from RGB, strength from
// alpha. KHR_materials_pbrSpecularGlossiness: F0 from RGB, glossiness from alpha; the diffuse colour is
// scaled by what the largest component of F0 leaves.
void Materials::reflect(const Hit& hit, const PixelRay& ray, Surface& s) const {
    const Material& m = material(hit);
    const double ior = m.ior, r = (1 - ior) / (1 + ior);
    const glm::dvec4 colored = lookUp<&Material::specular_color_texture>(m, hit, &ray);
    const glm::dvec3 tint = glm::dvec3(m.specular_color) * glm::dvec3(colored);
    s.dielectric_f90 = double{m.specular} * lookUp<&Material::specular_texture>(m, hit, &ray).a;
    s.dielectric_f0 = glm::min(r * r * tint, glm::dvec3(1)) * s.dielectric_f90;
    if (!m.specular_glossiness) return;
    s.roughness = 1 - (1 - double{m.roughness}) * colored.a;
    s.albedo *= 1 - std::max({s.dielectric_f0.r, s.dielectric_f0.g, s.dielectric_f0.b});
}

}  // namespace diptych::reference
