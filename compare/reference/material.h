// SPDX-License-Identifier: MIT
// The material at a point of a triangle, computed from the glTF factors and textures independently of the
// paths.
#pragma once

#include "compare/reference/geometry.h"
#include "compare/reference/surface.h"
#include "compare/reference/texture.h"

namespace diptych::reference {

// A camera ray, and its differences to the rays of the next pixel to the right and below. Origins are
// relative to the camera; directions are one metre of depth long.
struct PixelRay {
    glm::dvec3 origin{0}, direction{0};
    glm::dvec3 origin_dx{0}, direction_dx{0}, origin_dy{0}, direction_dy{0};  // differences to the neighbours
};

// Whether a surface's base has its light from a lightmap, black or not, and not from the environment.
inline bool hasLightmap(const Material& m) {
    return !m.unlit && m.lightmap_texture.texture >= 0 && m.lightmap_intensity != 0;
}

// Whether it is blended over what lies behind it.
inline bool isSeenThrough(const Material& m) {
    return m.alpha_mode == AlphaMode::blend || (!m.unlit && m.transmission > 0);
}

class Materials {
public:
    // Those of the pose. All arguments must outlive this.
    Materials(const Scene& scene, const Pose& pose, const Geometry& geometry)
        : scene_(scene), materials_(materialsOf(scene, pose)), geometry_(geometry), textures_(scene) {}

    // Whether a camera ray ends at the hit: not on the back of a single-sided material, nor where a mask
    // cuts it out.
    bool isThere(const Hit& hit, const PixelRay* ray) const;
    // Whether the hit occludes a light. Both sides of a triangle do, unless its material blends; masks are
    // read without filtering.
    bool throwsShadow(const Hit& hit) const;

    Surface surface(const Hit& hit, const PixelRay& ray) const;

    // Whether it is blended over what lies behind it.
    bool blends(const Hit& hit) const;
    // The base colour's alpha if the material's mode is BLEND, otherwise 1: the share of the place that the
    // surface covers.
    double coverage(const Hit& hit, const PixelRay& ray) const;

private:
    const Material& material(const Hit& hit) const;
    Footprint footprint(const Hit& hit, const TextureSlot& slot, const PixelRay* ray) const;
    glm::dvec4 lookUp(const Hit& hit, const TextureSlot& slot, bool srgb, const PixelRay* ray) const;
    glm::dvec4 baseColor(const Hit& hit, const PixelRay* ray) const;
    // Fills the normal, and what a normal map is read with and holds.
    void shadeNormal(const Hit& hit, const PixelRay& ray, Surface& s) const;

    const Scene& scene_;
    const std::vector<Material>& materials_;
    const Geometry& geometry_;
    Textures textures_;
};

}  // namespace diptych::reference
