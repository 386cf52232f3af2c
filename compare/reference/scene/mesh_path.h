// SPDX-License-Identifier: MIT
// The way of light through a closed mesh, traced from the viewer.
#pragma once

#include "compare/reference/scattering/sampling.h"
#include "compare/reference/scattering/surface.h"
#include "compare/reference/scene/geometry.h"
#include "compare/reference/scene/material.h"

#include <optional>

namespace diptych::reference {

// Refracts where it enters, follows the ray to the inside of the mesh's surface, and there chooses by a
// random number whether it is reflected or leaves, by Fresnel's equations.
class MeshPaths {
public:
    // Both must outlive this.
    MeshPaths(const Geometry& geometry, const Materials& materials)
        : geometry_(geometry), materials_(materials) {}

    // Meetings with the inside of a mesh, after which a path counts as absorbed.
    static constexpr int maxEvents = 16;

    // The last part of a path: it leaves the mesh, or meets an opaque surface in it. Through a mesh that is
    // open it goes on.
    struct End {
        glm::dvec3 origin, direction;  // relative to the camera; unit
        TriangleId without;            // on which `origin` is
        double from = 0;               // m; above rounding errors
        double length = 0;             // m, in the medium
    };
    // `entry`: on the front of the mesh; `surface`: there. `index`: of refraction. Empty if absorbed.
    std::optional<End> operator()(const Hit& entry, const Surface& surface, double index,
                                  Random& random) const;

private:
    // A boundary of the medium as light sees it that arrives `along`: normals are on the side of that light.
    struct Boundary {
        glm::dvec3 normal, geometric_normal;
        double roughness;
    };
    // The normal of the facet that light meets; a rough boundary has a random one among the visible ones.
    static glm::dvec3 facetOf(const Boundary& boundary, const glm::dvec3& along, Random& random);
    static glm::dvec3 entered(const Boundary& boundary, const glm::dvec3& along, double index,
                              Random& random);
    // The direction after an inner meeting; `leaves`: whether it is outside.
    struct Branch {
        glm::dvec3 direction;
        bool leaves;
    };
    static Branch branched(const Boundary& boundary, const glm::dvec3& along, double index, Random& random);
    // The next hit from inside on the mesh of `entry`, or on an opaque surface.
    std::optional<Hit> next(const Ray& ray, const TriangleId& entry) const;
    bool isSameMesh(const TriangleId& a, const TriangleId& b) const;

    const Geometry& geometry_;
    const Materials& materials_;
};

}  // namespace diptych::reference
