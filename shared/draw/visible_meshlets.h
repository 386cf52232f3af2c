// SPDX-License-Identifier: MIT
// Meshlets of an instance, and triangles of these, that may be visible in a view. Culled triangles cover
// no sample on any device, whatever its rounding, so images do not change. No Vulkan.
#pragma once

#include "shared/draw/meshlet_triangles.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace diptych {

// Size and samples of a view's image.
struct SampleGrid {
    int width = 0, height = 0;  // pixels
    int samples = 1;            // per pixel, at Vulkan's standard locations: 1, 2, 4 or 8
    double snap = 1.0 / 16;     // pixels: largest distance by which a rasterizer snaps a vertex
};

// Error bound of a vertex's window position for exact clip coordinates, pixels.
double positionError(const SampleGrid& grid);

// Visibility of one instance.
class VisibleMeshlets {
public:
    // `clip_from_object`: for positions in the box from `min` to `max`, m; shaders multiply in float32.
    // `culls_backs`: the draw culls back faces. `mirrored`: front faces are counter-clockwise in object
    // space and clockwise on screen.
    VisibleMeshlets(const SampleGrid& grid, const glm::dmat4& clip_from_object, const glm::dvec3& min,
                    const glm::dvec3& max, bool culls_backs, bool mirrored);

    // Triangles of the meshlet that may be visible.
    TriangleSet of(const Meshlet& meshlet, const MeshletTriangles& triangles,
                   const MeshletTriangles::Entry& entry) const;
    // Error bound of a shader's product of the matrix and a position, per component of clip space.
    const glm::dvec4& error() const { return error_; }

private:
    struct Side {
        glm::dvec3 normal, size;  // absolute values of the normal
        double w, slack;
    };
    // Error bound of a meshlet corner's window position, pixels. `nearest`: its smallest w.
    double positionErrorOf(double nearest) const;
    bool isBetweenSamples(const Meshlet& meshlet, double nearest, double off) const;

    SampleGrid grid_;
    glm::dmat4 rows_;            // of clip_from_object
    glm::dvec4 error_;           // error bound of clip space, per component
    std::array<Side, 6> sides_;  // clip planes, positive inside
    bool within_ = false;        // the whole instance is inside the frustum
    bool faces_ = false;         // back faces are culled
    bool culls_backs_, mirrored_;
    bool eye_at_infinity_ = false;
    glm::dvec3 eye_{0};
    glm::dvec3 pixels_{0};   // at w = 1: pixels per metre horizontally, vertically, in any direction
    double area_scale_ = 0;  // pixels^2 per doubled area of a triangle, times w^3
};

}  // namespace diptych
