// SPDX-License-Identifier: MIT
#include "shared/draw/meshlet_triangles.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>

namespace diptych {

namespace {

// Arrays are padded with 0 to a multiple of this, so that compilers vectorize their loops.
constexpr std::size_t laneCount = 8;

constexpr std::uint16_t filledUp(std::size_t count) {
    return static_cast<std::uint16_t>((count + laneCount - 1) / laneCount * laneCount);
}

// Edge function of the edge from a to b, relative to the first sample: positive inside, with the sign
// `turn`; and its increments to the next sample across and down.
struct EdgeSide {
    float at, across, down;
    EdgeSide(float turn, const glm::vec2& a, const glm::vec2& b)
        : at(turn * (a.x * b.y - a.y * b.x)), across(turn * (a.y - b.y)), down(turn * (b.x - a.x)) {}
};

}  // namespace

void MeshletTriangles::add(const Meshlet& meshlet, std::span<const glm::vec3> positions,
                           std::span<const std::uint32_t> indices) {
    Entry entry;
    const std::size_t count = indices.size() / 3;
    entry.triangles = static_cast<std::uint16_t>(count);
    entry.planes = filledUp(count);
    entry.first_plane = static_cast<std::uint32_t>(values_.size());
    values_.resize(values_.size() + std::size_t{4} * entry.planes);
    const glm::dvec3 middle = middleOf(meshlet);
    double largest = 0, shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
        std::array<glm::dvec3, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) corners[c] = glm::dvec3(positions[indices[3 * i + c]]) - middle;
        const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double perimeter = glm::distance(corners[0], corners[1]) +
                                 glm::distance(corners[1], corners[2]) +
                                 glm::distance(corners[2], corners[0]);
        // A degenerate triangle faces nowhere: all 0, which is never behind.
        if (!(glm::length(cross) > 0)) continue;
        const glm::dvec3 normal = cross / perimeter;
        float* const value = values_.data() + entry.first_plane + i;
        value[0] = static_cast<float>(normal.x);
        value[entry.planes] = static_cast<float>(normal.y);
        value[2 * entry.planes] = static_cast<float>(normal.z);
        value[3 * entry.planes] = static_cast<float>(glm::dot(normal, corners[0]));
        largest = std::max(largest, glm::length(normal));
        shortest = std::min(shortest, perimeter);
    }
    entry.largest_circle = static_cast<float>(largest);
    entry.shortest_perimeter = static_cast<float>(shortest);
    entry.radius = static_cast<float>(glm::distance(glm::dvec3(meshlet.max), middle));

    std::vector<std::uint32_t> used(indices.begin(), indices.end());
    std::ranges::sort(used);
    used.erase(std::ranges::unique(used).begin(), used.end());
    entry.corners = filledUp(used.size());
    entry.first_corner = static_cast<std::uint32_t>(values_.size());
    values_.resize(values_.size() + std::size_t{3} * entry.corners);
    for (std::size_t i = 0; i < used.size(); ++i) {
        const glm::vec3 position(glm::dvec3(positions[used[i]]) - middle);
        float* const value = values_.data() + entry.first_corner + i;
        value[0] = position.x;
        value[entry.corners] = position.y;
        value[2 * entry.corners] = position.z;
    }
    entry.first_corner_index = static_cast<std::uint32_t>(corner_indices_.size());
    for (const std::uint32_t index : indices)
        corner_indices_.push_back(
            static_cast<std::uint8_t>(std::ranges::lower_bound(used, index) - used.begin()));
    entries_.push_back(entry);
}

void MeshletTriangles::add(const MeshletTriangles& others) {
    constexpr std::size_t max = std::numeric_limits<std::uint32_t>::max();
    const std::size_t values = values_.size(), corner_indices = corner_indices_.size();
    if (values + others.values_.size() > max || corner_indices + others.corner_indices_.size() > max)
        throw std::runtime_error("the scene has over 2^29 triangles, too many for culling");
    values_.insert(values_.end(), others.values_.begin(), others.values_.end());
    corner_indices_.insert(corner_indices_.end(), others.corner_indices_.begin(),
                           others.corner_indices_.end());
    for (Entry entry : others.entries_) {
        entry.first_plane += static_cast<std::uint32_t>(values);
        entry.first_corner += static_cast<std::uint32_t>(values);
        entry.first_corner_index += static_cast<std::uint32_t>(corner_indices);
        entries_.push_back(entry);
    }
}

TriangleSet MeshletTriangles::facing(const Entry& entry, const glm::vec3& eye, float eye_w, float min) const {
    const float* const x = values_.data() + entry.first_plane;
    const float *const y = x + entry.planes, *const z = y + entry.planes, *const d = z + entry.planes;
    std::array<float, maxMeshletTriangles> before;
    for (std::size_t i = 0; i < entry.planes; ++i)
        before[i] = x[i] * eye.x + y[i] * eye.y + z[i] * eye.z - d[i] * eye_w;
    TriangleSet set = 0;
    for (std::size_t i = 0; i < entry.triangles; ++i) set |= TriangleSet{!(before[i] < min)} << i;
    return set;
}

TriangleSet MeshletTriangles::covering(const Entry& entry, TriangleSet from,
                                       const Projection& projection) const {
    const float* const px = values_.data() + entry.first_corner;
    const float *const py = px + entry.corners, *const pz = py + entry.corners;
    std::array<float, filledUp(3 * maxMeshletTriangles)> atX, atY;
    const glm::vec4 &rowX = projection.x, &rowY = projection.y, &w = projection.w;
    for (std::size_t i = 0; i < entry.corners; ++i) {
        const float scale = 1.0f / (w.x * px[i] + w.y * py[i] + w.z * pz[i] + w.w);
        atX[i] = (rowX.x * px[i] + rowX.y * py[i] + rowX.z * pz[i] + rowX.w) * scale + projection.half.x;
        atY[i] = (rowY.x * px[i] + rowY.y * py[i] + rowY.z * pz[i] + rowY.w) * scale + projection.half.y;
    }
    // Displacement of a corner that is off by `off` in both coordinates.
    const float off = projection.off, wide = 1.4143f * off, turn = projection.clockwise ? 1.0f : -1.0f;
    TriangleSet covering = 0;
    for (TriangleSet left = from; left != 0; left &= left - 1) {
        const int triangle = std::countr_zero(left);
        const std::uint8_t* const corners = corner_indices_.data() + entry.first_corner_index + 3 * triangle;
        const glm::vec2 a(atX[corners[0]], atY[corners[0]]), b(atX[corners[1]], atY[corners[1]]),
            c(atX[corners[2]], atY[corners[2]]);
        const float low = std::min(a.x, std::min(b.x, c.x)) - off,
                    right = std::max(a.x, std::max(b.x, c.x)) + off,
                    top = std::min(a.y, std::min(b.y, c.y)) - off,
                    bottom = std::max(a.y, std::max(b.y, c.y)) + off;
        // Positions inside an image are above -1. Samples are at pixel centres.
        const auto firstX = static_cast<int>(low + 1.5f) - 1, firstY = static_cast<int>(top + 1.5f) - 1;
        const int across = static_cast<int>(right + 1.5f) - 1 - firstX,
                  down = static_cast<int>(bottom + 1.5f) - 1 - firstY;
        const bool large = across * down > 6;
        bool covers = large;
        if (!large) {
            // Moving a corner changes twice an area by at most the displacement times the distance of the
            // other points, which lie in this box with the sample. The factor covers float32 rounding.
            const float margin = wide * (2 * (right - low + bottom - top) + wide) * 1.01f;
            const glm::vec2 first(static_cast<float>(firstX) + 0.5f, static_cast<float>(firstY) + 0.5f);
            const EdgeSide ab(turn, a - first, b - first), bc(turn, b - first, c - first),
                ca(turn, c - first, a - first);
            // No branches on the result of a sample.
            for (int v = 0; v < down; ++v)
                for (int u = 0; u < across; ++u) {
                    const auto x = static_cast<float>(u), y = static_cast<float>(v);
                    const float one = ab.at + x * ab.across + y * ab.down,
                                two = bc.at + x * bc.across + y * bc.down,
                                three = ca.at + x * ca.across + y * ca.down;
                    const bool inside = std::min(one, std::min(two, three)) >= -margin,
                               behind = std::max(one, std::max(two, three)) <= margin;
                    covers = covers | inside | (behind & projection.either_side);
                }
        }
        covering |= TriangleSet{covers} << triangle;
    }
    return covering;
}

}  // namespace diptych
