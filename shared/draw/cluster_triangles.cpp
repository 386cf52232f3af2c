// SPDX-License-Identifier: MIT
#include "shared/draw/cluster_triangles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>

namespace diptych {

namespace {

// Arrays are filled up with 0 to a multiple of that, so that compilers make vectors of their loops.
constexpr std::size_t laneCount = 8;

constexpr std::uint16_t filledUp(std::size_t count) {
    return static_cast<std::uint16_t>((count + laneCount - 1) / laneCount * laneCount);
}

struct Corner {
    float x, y;
};

// Whether the corners, each of which may be off by `wide` pixels in any direction, leave the sample outside
// for certain. `turn`: 1 where fronts are clockwise with y down, else -1.
bool leavesOutside(const std::array<Corner, 3>& c, float x, float y, float margin, float turn, bool either) {
    bool below = false, above = false;
    for (std::size_t e = 0; e < 3; ++e) {
        const Corner &a = c[e], &b = c[(e + 1) % 3];
        const float side = turn * ((a.x - x) * (b.y - y) - (a.y - y) * (b.x - x));
        below = below || side < -margin;
        above = above || side > margin;
    }
    return below && (above || !either);
}

}  // namespace

void ClusterTriangles::add(const Cluster& cluster, std::span<const glm::vec3> positions,
                           std::span<const std::uint32_t> indices) {
    Entry entry;
    const std::size_t count = indices.size() / 3;
    entry.triangles = static_cast<std::uint16_t>(count);
    entry.planes = filledUp(count);
    entry.first_plane = static_cast<std::uint32_t>(values_.size());
    values_.resize(values_.size() + std::size_t{4} * entry.planes);
    const glm::dvec3 middle = middleOf(cluster);
    double largest = 0, shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
        std::array<glm::dvec3, 3> corners;
        for (std::size_t c = 0; c < 3; ++c) corners[c] = glm::dvec3(positions[indices[3 * i + c]]) - middle;
        const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double perimeter = glm::distance(corners[0], corners[1]) +
                                 glm::distance(corners[1], corners[2]) +
                                 glm::distance(corners[2], corners[0]);
        // Without an area it faces nowhere: all 0, which is never behind.
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
    entry.reach = static_cast<float>(glm::distance(glm::dvec3(cluster.max), middle));

    std::vector<std::uint32_t> used(indices.begin(), indices.end());
    std::ranges::sort(used);
    used.erase(std::ranges::unique(used).begin(), used.end());
    entry.corners = filledUp(used.size());
    entry.first_corner = static_cast<std::uint32_t>(values_.size());
    values_.resize(values_.size() + std::size_t{3} * entry.corners);
    for (std::size_t i = 0; i < used.size(); ++i) {
        const glm::vec3 place(glm::dvec3(positions[used[i]]) - middle);
        float* const value = values_.data() + entry.first_corner + i;
        value[0] = place.x;
        value[entry.corners] = place.y;
        value[2 * entry.corners] = place.z;
    }
    entry.first_number = static_cast<std::uint32_t>(numbers_.size());
    for (const std::uint32_t index : indices)
        numbers_.push_back(static_cast<std::uint8_t>(std::ranges::lower_bound(used, index) - used.begin()));
    entries_.push_back(entry);
}

void ClusterTriangles::add(const ClusterTriangles& others) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    const std::size_t values = values_.size(), numbers = numbers_.size();
    if (values + others.values_.size() > most || numbers + others.numbers_.size() > most)
        throw std::runtime_error("the scene has over 2^29 triangles: more than culling can number");
    values_.insert(values_.end(), others.values_.begin(), others.values_.end());
    numbers_.insert(numbers_.end(), others.numbers_.begin(), others.numbers_.end());
    for (Entry entry : others.entries_) {
        entry.first_plane += static_cast<std::uint32_t>(values);
        entry.first_corner += static_cast<std::uint32_t>(values);
        entry.first_number += static_cast<std::uint32_t>(numbers);
        entries_.push_back(entry);
    }
}

TriangleSet ClusterTriangles::facing(const Entry& entry, const glm::vec3& eye, float eye_w,
                                     float least) const {
    const float* const x = values_.data() + entry.first_plane;
    const float *const y = x + entry.planes, *const z = y + entry.planes, *const d = z + entry.planes;
    std::array<float, clusterTriangles> before;
    for (std::size_t i = 0; i < entry.planes; ++i)
        before[i] = x[i] * eye.x + y[i] * eye.y + z[i] * eye.z - d[i] * eye_w;
    TriangleSet set = 0;
    for (std::size_t i = 0; i < entry.triangles; ++i) set |= TriangleSet{!(before[i] < least)} << i;
    return set;
}

TriangleSet ClusterTriangles::covering(const Entry& entry, TriangleSet from,
                                       const Projection& projection) const {
    const float* const px = values_.data() + entry.first_corner;
    const float *const py = px + entry.corners, *const pz = py + entry.corners;
    std::array<float, filledUp(3 * clusterTriangles)> atX, atY;
    const glm::vec4 x = projection.x, y = projection.y, w = projection.w;
    for (std::size_t i = 0; i < entry.corners; ++i) {
        const float scale = 1.0f / (w.x * px[i] + w.y * py[i] + w.z * pz[i] + w.w);
        atX[i] = (x.x * px[i] + x.y * py[i] + x.z * pz[i] + x.w) * scale + projection.half.x;
        atY[i] = (y.x * px[i] + y.y * py[i] + y.z * pz[i] + y.w) * scale + projection.half.y;
    }
    // A corner that is off by as much across and down.
    const float off = projection.off, wide = 1.4143f * off, turn = projection.clockwise ? 1.0f : -1.0f;
    TriangleSet covering = 0;
    for (TriangleSet left = from; left != 0; left &= left - 1) {
        const int number = std::countr_zero(left);
        const std::uint8_t* const corners = numbers_.data() + entry.first_number + 3 * number;
        const std::array<Corner, 3> c{{{atX[corners[0]], atY[corners[0]]},
                                       {atX[corners[1]], atY[corners[1]]},
                                       {atX[corners[2]], atY[corners[2]]}}};
        const float low = std::min(c[0].x, std::min(c[1].x, c[2].x)) - off,
                    right = std::max(c[0].x, std::max(c[1].x, c[2].x)) + off,
                    top = std::min(c[0].y, std::min(c[1].y, c[2].y)) - off,
                    bottom = std::max(c[0].y, std::max(c[1].y, c[2].y)) + off;
        // Of what lies wholly in a picture all places are above -1. Samples are in the middle of pixels.
        const auto firstX = static_cast<int>(low + 1.5f) - 1, lastX = static_cast<int>(right + 1.5f) - 2,
                   firstY = static_cast<int>(top + 1.5f) - 1, lastY = static_cast<int>(bottom + 1.5f) - 2;
        const int across = lastX - firstX + 1, down = lastY - firstY + 1;
        bool covers = false;
        if (across > 0 && down > 0) {
            covers = across * down > 6;
            // A corner's move changes twice an area by its size times how far the others are, and those are
            // in this box with the sample; once more for what float32 rounds away.
            const float margin = wide * (2 * (right - low + bottom - top) + wide) * 1.01f;
            for (int v = firstY; v <= lastY && !covers; ++v)
                for (int u = firstX; u <= lastX && !covers; ++u)
                    covers = !leavesOutside(c, static_cast<float>(u) + 0.5f, static_cast<float>(v) + 0.5f,
                                            margin, turn, projection.either_side);
        }
        covering |= TriangleSet{covers} << number;
    }
    return covering;
}

}  // namespace diptych
