// SPDX-License-Identifier: MIT
// Triangles of a meshlet that may be visible: those that face an eye, and those that may cover a sample.
// No Vulkan.
#pragma once

#include "shared/draw/meshlets.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// Origin of a meshlet's planes and corners.
inline glm::dvec3 middleOf(const Meshlet& meshlet) {
    return (glm::dvec3(meshlet.min) + glm::dvec3(meshlet.max)) * 0.5;
}

// Set of a meshlet's triangles, one bit each.
using TriangleSet = std::uint64_t;
static_assert(maxMeshletTriangles <= 64);

// Culling data of any number of meshlets.
class MeshletTriangles {
public:
    // Data of one meshlet. A plane's normal has as its length the inradius r of the triangle; d is its dot
    // product with any point of the triangle. For an eye e, dot(normal, e) - d is r times the distance
    // from the plane, negative behind the triangle.
    struct Entry {
        std::uint32_t first_plane = 0;         // offset of `planes` x of normals, then as many y, z and d
        std::uint32_t first_corner = 0;        // offset of `corners` x of positions, then as many y and z
        std::uint32_t first_corner_index = 0;  // offset of the triangles' corner indices, three each
        std::uint16_t planes = 0, corners = 0, triangles = 0;
        // Over the triangles with an area, m: largest inradius r and shortest perimeter.
        float largest_circle = 0, shortest_perimeter = 0;
        float radius = 0;  // m, from the centre to a corner of the box
        TriangleSet all() const {
            return triangles < 64 ? (TriangleSet{1} << triangles) - 1 : ~TriangleSet{0};
        }
    };

    // `indices`: of the meshlet, three per triangle, all below positions.size(). Positions in object
    // space, m.
    void add(const Meshlet& meshlet, std::span<const glm::vec3> positions,
             std::span<const std::uint32_t> indices);
    // Appends the meshlets of another.
    void add(const MeshletTriangles& others);
    const Entry& operator[](std::size_t meshlet) const { return entries_[meshlet]; }
    std::uint64_t bytes() const {
        return values_.size() * sizeof(float) + corner_indices_.size() + entries_.size() * sizeof(Entry);
    }

    // Triangles whose dot(normal, eye) - eye_w * d is not below `min`. `eye`: relative to the meshlet's
    // centre.
    TriangleSet facing(const Entry& entry, const glm::vec3& eye, float eye_w, float min) const;

    // Projects points relative to the meshlet's centre to pixels of an image with one sample per pixel:
    // (dot(x, point), dot(y, point)) / dot(w, point) + half, where w is positive.
    struct Projection {
        glm::vec4 x{0}, y{0}, w{0};
        glm::vec2 half{0};
        float off = 0;            // error bound of each coordinate, pixels
        bool either_side = true;  // both sides of triangles are visible; else only front faces
        bool clockwise = false;   // front faces are clockwise in the image
    };
    // Those of `from` that may cover a sample. Tests triangles of a few pixels; keeps larger ones.
    TriangleSet covering(const Entry& entry, TriangleSet from, const Projection& projection) const;

private:
    std::vector<Entry> entries_;
    std::vector<float> values_;
    std::vector<std::uint8_t> corner_indices_;
};

}  // namespace diptych
