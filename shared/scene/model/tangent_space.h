// SPDX-License-Identifier: MIT
// M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, section 3, in that paper's terms.
// Vertices are welded if position, normal and UV agree. Each triangle has first-order derivatives of
// position by s and t. Triangles around a vertex that share edges and orientation form a group. A group's
// tangent is the angle-weighted mean of its triangles' tangents, each projected into the plane of the
// vertex normal. The default angular threshold of 180 degrees never splits a group, so there is no
// threshold. t is 1 - v: the bitangent must point to the top of the image (glTF's +Y of a normal map), but
// v grows downwards. Computed in double from float inputs.
//
// UV means the map's coordinates (tangentMap()) after KHR_texture_transform, because a rotated or mirrored
// map has its own directions on the surface.
//
// If morph targets affect tangents, groups must be valid in every pose. Vertices are then welded only if
// all targets move them alike, and those of a flat primitive only within a triangle.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych {

// A unit vector perpendicular to the normal, sign +1.
glm::vec4 anyTangent(const glm::vec3& normal);

// Whether a target changes what determines tangents: positions, normals or this UV set (0 or 1).
bool movesTangents(const MorphTarget& target, int texcoord);

class TangentSpace {
public:
    // The primitive must have the map's UV set, 0 or 1, and outlive this object.
    TangentSpace(const Primitive& primitive, const TextureSlot& map);

    // The tangent at index `corner` of the index list.
    glm::vec4 at(std::size_t corner) const;

    // Corners with the same value share a tangent in every pose. Below groupCount(); some values may be
    // unused.
    std::uint32_t groupAt(std::size_t corner) const;
    std::uint32_t groupCount() const;

    // Whether a triangle has derivatives of position by s and t, or may get them from morph targets.
    bool counts(std::size_t triangle) const;

private:
    struct Triangle {
        std::array<int, 3> vertex;                // welded
        std::array<int, 3> neighbor{-1, -1, -1};  // across the edge from corner i to i + 1
        std::array<int, 3> group{-1, -1, -1};     // of corner i
        glm::dvec3 tangent{0};                    // unit dP/ds
        bool degenerate = false;
        bool orientation_preserving = false;
        bool joins_any = true;  // has no derivatives: joins the first group that reaches it
    };

    glm::dvec3 position(int v) const;
    glm::dvec3 normal(int v) const;
    glm::dvec2 st(int v) const;
    void weld();
    void derive();
    void findNeighbors();
    int& neighborAt(int triangle, int corner);
    void group();
    void average();
    void findMoves();

    const Primitive& primitive_;
    const TextureSlot& map_;
    const std::vector<glm::vec2>& texcoords_;
    bool morphed_ = false;               // whether a target affects tangents
    std::vector<std::uint32_t> source_;  // welded vertex -> the primitive's first such vertex
    std::vector<Triangle> triangles_;
    // Hash of each welded vertex's position deltas; empty if no target moves positions.
    std::vector<std::uint64_t> moved_;
    bool slides_ = false;  // whether a target moves texture coordinates
    std::vector<int> vertex_of_group_;
    std::vector<int> group_of_vertex_;  // the first group at each welded vertex
    std::vector<bool> preserving_;      // per group
    std::vector<glm::dvec3> tangents_;  // per group
};

}  // namespace diptych
