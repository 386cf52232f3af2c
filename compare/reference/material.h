// SPDX-License-Identifier: MIT
// The surface at a place on a triangle, from the glTF's factors and textures: its own, not the paths'.
#pragma once

#include "compare/reference/geometry.h"
#include "compare/reference/surface.h"
#include "compare/reference/texture.h"

namespace diptych::reference {

// A ray of a picture and those of the next pixel to the right and below: origins from the camera, directions
// a metre of depth long.
struct PixelRay {
    glm::dvec3 origin{0}, direction{0};
    glm::dvec3 origin_dx{0}, direction_dx{0}, origin_dy{0}, direction_dy{0};  // differences
};

class Materials {
public:
    Materials(const Scene& scene, const Geometry& geometry)
        : scene_(scene), geometry_(geometry), textures_(scene) {}

    // Whether a ray of the picture ends there: not on the back of what has none, not where a mask is cut out.
    bool isThere(const Hit& hit, const PixelRay* ray) const;
    // A shadow comes from both sides of everything but of what blends; masks are read at a point.
    bool throwsShadow(const Hit& hit) const;

    Surface surface(const Hit& hit, const PixelRay& ray) const;

    // Base colour's alpha where the material blends; 1 where it does not.
    double opacity(const Hit& hit, const PixelRay& ray) const;

private:
    const Material& material(const Hit& hit) const;
    Footprint footprint(const Hit& hit, const TextureSlot& slot, const PixelRay* ray) const;
    glm::dvec4 lookUp(const Hit& hit, const TextureSlot& slot, bool srgb, const PixelRay* ray) const;
    glm::dvec4 baseColor(const Hit& hit, const PixelRay* ray) const;
    glm::dvec3 shadingNormal(const Hit& hit, const PixelRay& ray) const;

    const Scene& scene_;
    const Geometry& geometry_;
    Textures textures_;
};

}  // namespace diptych::reference
