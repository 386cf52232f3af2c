// SPDX-License-Identifier: MIT
// The material at a point of a triangle, from the glTF factors and textures, independent of the paths.
#pragma once

#include "compare/reference/scattering/surface.h"
#include "compare/reference/scene/geometry.h"
#include "compare/reference/scene/texture.h"

#include <glm/geometric.hpp>

namespace diptych {
struct RotatedMaps;
}

namespace diptych::reference {

// A camera ray and its differences to the rays of the next pixels to the right and below. Origins are
// relative to the camera; directions advance one metre in depth.
struct PixelRay {
    glm::dvec3 origin{0}, direction{0};
    glm::dvec3 origin_dx{0}, direction_dx{0}, origin_dy{0}, direction_dy{0};
};

// Whether a lightmap, black or not, replaces the environment's light at the base.
inline bool hasLightmap(const Material& m) {
    return !m.unlit && m.lightmap_texture.texture >= 0 && m.lightmap_intensity != 0;
}

// Whether it transmits light without diffusion.
inline bool letsThrough(const Material& m) {
    return !m.unlit && m.transmission > 0;
}

// Whether surfaces behind it are visible: it blends or transmits light.
inline bool isSeenThrough(const Material& m) {
    return m.alpha_mode == AlphaMode::blend || letsThrough(m);
}

class Materials {
public:
    // Uses the pose's materials. All arguments must outlive this.
    Materials(const Scene& scene, const Pose& pose, const Geometry& geometry)
        : scene_(scene), materials_(materialsOf(scene, pose)), geometry_(geometry), textures_(scene) {}

    // Whether a camera ray ends at the hit: false on the back of a single-sided material and where a mask
    // cuts it out.
    bool isThere(const Hit& hit, const PixelRay* ray) const;
    // Whether the hit blocks light. Both sides of a triangle do, unless its material blends. Masks are not
    // filtered.
    bool throwsShadow(const Hit& hit) const;

    Surface surface(const Hit& hit, const PixelRay& ray) const;

    // Whether surfaces behind it are visible: it blends or transmits light.
    bool blends(const Hit& hit) const;
    bool transmits(const Hit& hit) const;
    // Whether it bounds a volume; otherwise it is a thin wall.
    bool isThick(const Hit& hit) const;
    // Whether a mask cuts out the hit; the side does not matter.
    bool isHole(const Hit& hit) const;
    // The base colour's alpha if the material's mode is BLEND, otherwise 1.
    double coverage(const Hit& hit, const PixelRay& ray) const;

private:
    const Material& material(const Hit& hit) const;
    Footprint footprint(const Hit& hit, const TextureSlot& slot, const PixelRay* ray) const;
    // A texel of a slot, by its member; white without a texture.
    template <TextureSlot Material::*texture>
    glm::dvec4 lookUp(const Material& m, const Hit& hit, const PixelRay* ray) const;
    glm::dvec4 baseColor(const Hit& hit, const PixelRay* ray) const;
    // The frame of normal maps, world space, interpolated without normalisation.
    struct Frame {
        glm::dvec3 normal, tangent;
        double sign;                // bitangent = sign * cross(normal, tangent)
        glm::dvec2 rotation{1, 0};  // the tangent of rotated maps, along tangent and bitangent
        bool mirrored = false;      // whether their bitangent has the other sign
        glm::dvec3 bitangent() const { return sign * glm::cross(normal, tangent); }
        glm::dvec3 world(const glm::dvec3& t) const {
            return t.x * tangent + t.y * bitangent() + t.z * normal;
        }
        glm::dvec3 rotatedWorld(const glm::dvec3& t) const {
            const glm::dvec3 b = bitangent(), along = rotation.x * tangent + rotation.y * b,
                             across = rotation.x * b - rotation.y * tangent;
            return t.x * along + (mirrored ? -t.y : t.y) * across + t.z * normal;
        }
    };
    Frame frameAt(const Hit& hit) const;
    // A vector of the map of a layer, whose tangents may be its own (`of`).
    static glm::dvec3 worldOf(const Material& m, const Frame& frame, bool (RotatedMaps::*of)() const,
                              const glm::dvec3& t);
    // A normal map's value, tangent space, not normalised.
    template <TextureSlot Material::*texture>
    glm::dvec3 mapped(const Material& m, const Hit& hit, float scale, const PixelRay& ray) const;
    // Fills the normal, and the tangent frame and tangent-space normal of a normal map.
    void shadeNormal(const Hit& hit, const PixelRay& ray, const Frame& frame, Surface& s) const;
    // Fills the dielectric layer, and the base colour and roughness of specular-glossiness.
    void reflect(const Hit& hit, const PixelRay& ray, Surface& s) const;
    void coat(const Hit& hit, const PixelRay& ray, const Frame& frame, Surface& s) const;
    void stretch(const Hit& hit, const PixelRay& ray, const Frame& frame, Surface& s) const;
    void sheen(const Hit& hit, const PixelRay& ray, Surface& s) const;
    void film(const Hit& hit, const PixelRay& ray, Surface& s) const;
    void transmit(const Hit& hit, const PixelRay& ray, Surface& s) const;
    double thicknessAt(const Hit& hit, const PixelRay& ray) const;  // of a slab, m
    void transmitDiffusely(const Hit& hit, const PixelRay& ray, Surface& s) const;

    const Scene& scene_;
    const std::vector<Material>& materials_;
    const Geometry& geometry_;
    Textures textures_;
};

}  // namespace diptych::reference
