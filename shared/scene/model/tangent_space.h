// SPDX-License-Identifier: MIT
// M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, section 3, in the words used there:
// vertices are welded where position, normal and UV agree; each triangle has the first-order derivatives
// of position by s and t; triangles around a vertex that share edges and orientation form a group; a
// group's tangent is the angle-weighted mean of its triangles' tangents, each projected into the plane of
// the vertex normal. The algorithm's default angular threshold of 180 degrees never splits a group, so
// none is applied. t is 1 - v: the bitangent must point towards the top of the picture (glTF's +Y of a
// normal map), and v grows downwards. Double throughout; inputs are float.
//
// UV are the coordinates that the normal map is read with, after KHR_texture_transform: a map that is turned
// or mirrored has its own directions on the surface.
//
// Where morph targets move what tangents follow from, a group must hold in every pose: vertices are welded
// only if all targets move them alike too, and those of a flat primitive, whose normals are each triangle's
// own, only within a triangle.
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

// Whether a target moves what tangents follow from: positions, normals or this UV set (0 or 1).
bool movesTangents(const MorphTarget& target, int texcoord);

class TangentSpace {
public:
    // The primitive has the map's UV set, 0 or 1, and outlives this.
    TangentSpace(const Primitive& primitive, const TextureSlot& map);

    // The tangent at corner `corner` of the index list.
    glm::vec4 at(std::size_t corner) const;

    // A number that two corners have in common if their vertices share a tangent in every pose of the
    // primitive; below groupCount(), though not every number is used.
    std::uint32_t groupAt(std::size_t corner) const;
    std::uint32_t groupCount() const;

    // Whether a triangle has, or may get from morph targets, derivatives of position by s and t.
    bool counts(std::size_t triangle) const;

private:
    struct Triangle {
        std::array<int, 3> vertex;                // welded
        std::array<int, 3> neighbor{-1, -1, -1};  // across the edge from corner i to corner i + 1
        std::array<int, 3> group{-1, -1, -1};     // that corner i belongs to
        glm::dvec3 tangent{0};                    // unit dP/ds
        bool degenerate = false;
        bool orientation_preserving = false;
        bool joins_any = true;  // has no derivative of its own: it joins whichever group reaches it first
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
    bool morphed_ = false;               // whether a target moves what tangents follow from
    std::vector<std::uint32_t> source_;  // welded vertex -> the first of the primitive's that it stands for
    std::vector<Triangle> triangles_;
    std::vector<std::uint64_t>
        moved_;            // by welded vertex: a hash of its position's deltas; empty: no target moves
    bool slides_ = false;  // whether a target moves texture coordinates
    std::vector<int> vertex_of_group_;
    std::vector<int> group_of_vertex_;  // the first group at each welded vertex
    std::vector<bool> preserving_;      // per group
    std::vector<glm::dvec3> tangents_;  // per group
};

}  // namespace diptych
