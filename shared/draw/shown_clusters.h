// SPDX-License-Identifier: MIT
// Which clusters of an instance, and which of their triangles, a view may show. What is left out covers no
// sample, however a device rounds: no bit of a picture changes. No Vulkan.
#pragma once

#include "shared/draw/cluster_triangles.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace diptych {

// What a view is drawn to.
struct SampleGrid {
    int width = 0, height = 0;  // pixels
    int samples = 1;            // of a pixel, at the standard places of Vulkan: 1, 2, 4 or 8
    double snap = 1.0 / 16;     // pixels: how far a rasteriser moves a corner, at most
};

// What a device's place of a corner may be off by where its clip space is exact, pixels.
double placeError(const SampleGrid& grid);

// Of one instance.
class ShownClusters {
public:
    // `clip_from_object`: of all positions, which lie in the box from `min` to `max`, m; a shader multiplies
    // in float32. `culls_backs`: the draw shows no backs; `mirrored`: fronts are counter-clockwise in object
    // space, and clockwise on the screen.
    ShownClusters(const SampleGrid& grid, const glm::dmat4& clip_from_object, const glm::dvec3& min,
                  const glm::dvec3& max, bool culls_backs, bool mirrored);

    // Those of the cluster that may show.
    TriangleSet of(const Cluster& cluster, const ClusterTriangles& triangles,
                   const ClusterTriangles::Entry& entry) const;
    // What a shader's product of the matrix and a position may be off by, by component of clip space.
    const glm::dvec4& error() const { return error_; }

private:
    struct Side {
        glm::dvec3 normal, size;  // its components' sizes
        double w, slack;
    };
    // `off`: how far a place may be off, pixels.
    // Where a corner of the cluster may come to lie beside its place, pixels.
    double placeOff(double nearest) const;
    bool isBetweenSamples(const Cluster& cluster, double nearest, double off) const;

    SampleGrid grid_;
    glm::dmat4 rows_;            // of clip_from_object
    glm::dvec4 error_;           // of clip space, by component
    std::array<Side, 6> sides_;  // of what is inside, positive
    bool within_ = false;        // all of the instance is inside
    bool faces_ = false;         // backs are left out
    bool culls_backs_, mirrored_;
    bool eye_at_infinity_ = false;
    glm::dvec3 eye_{0};
    glm::dvec3 pixels_{0};   // at w = 1: how far a step of 1 m moves a point, across, down, either
    double area_scale_ = 0;  // pixels^2 of a triangle's doubled area, times w^3
};

}  // namespace diptych
