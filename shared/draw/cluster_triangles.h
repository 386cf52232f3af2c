// SPDX-License-Identifier: MIT
// Which triangles of a cluster may show: those that do not face away from an eye, and those that may cover a
// sample. No Vulkan.
#pragma once

#include "shared/draw/clusters.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// A point that a cluster's planes and corners are counted from.
inline glm::dvec3 middleOf(const Cluster& cluster) {
    return (glm::dvec3(cluster.min) + glm::dvec3(cluster.max)) * 0.5;
}

// Some triangles of a cluster, a bit each.
using TriangleSet = std::uint64_t;
static_assert(clusterTriangles <= 64);

// Any number of clusters.
class ClusterTriangles {
public:
    // Of one. The plane of a triangle is a normal as long as the radius r of the circle in the triangle, and
    // the normal's product d with any point of the triangle: for an eye e, dot(normal, e) - d is r times the
    // distance from the plane, negative behind the triangle.
    struct Entry {
        std::uint32_t first_plane = 0;   // `planes` x of normals, as many y, z and d
        std::uint32_t first_corner = 0;  // `corners` x of places, as many y and z
        std::uint32_t first_number = 0;  // of a triangle's corners, three each
        std::uint16_t planes = 0, corners = 0, triangles = 0;
        // Of the triangles that have an area, m: the largest r, and the shortest way around one.
        float largest_circle = 0, shortest_perimeter = 0;
        float reach = 0;  // m, from the middle to a corner of the box
        TriangleSet all() const {
            return triangles < 64 ? (TriangleSet{1} << triangles) - 1 : ~TriangleSet{0};
        }
    };

    // `indices`: of the cluster, three a triangle, all below positions.size(). Positions in object space, m.
    void add(const Cluster& cluster, std::span<const glm::vec3> positions,
             std::span<const std::uint32_t> indices);
    // Those of another, after these.
    void add(const ClusterTriangles& others);
    const Entry& operator[](std::size_t cluster) const { return entries_[cluster]; }
    std::uint64_t bytes() const {
        return values_.size() * sizeof(float) + numbers_.size() + entries_.size() * sizeof(Entry);
    }

    // Those whose dot(normal, eye) - eye_w * d is not below `least`. `eye`: from the cluster's middle.
    TriangleSet facing(const Entry& entry, const glm::vec3& eye, float eye_w, float least) const;

    // How places from the cluster's middle come to lie on a picture of one sample a pixel, in pixels:
    // (dot(x, place), dot(y, place)) / dot(w, place) + half, where w is positive.
    struct Projection {
        glm::vec4 x{0}, y{0}, w{0};
        glm::vec2 half{0};
        float off = 0;            // each coordinate may be off by that, pixels
        bool either_side = true;  // both sides of triangles show; else fronts
        bool clockwise = false;   // fronts are, as the picture shows them
    };
    // Of `from` those that may cover a sample, when they are few pixels large; larger ones stay.
    TriangleSet covering(const Entry& entry, TriangleSet from, const Projection& projection) const;

private:
    std::vector<Entry> entries_;
    std::vector<float> values_;
    std::vector<std::uint8_t> numbers_;
};

}  // namespace diptych
