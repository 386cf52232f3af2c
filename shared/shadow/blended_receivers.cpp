// SPDX-License-Identifier: MIT
#include "shared/shadow/blended_receivers.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace diptych {

namespace {

using Corners = std::array<glm::dvec3, 3>;  // world axes, relative to the eye

// Part of a convex polygon on the side of the plane where dot(side, (p, 1)) >= 0 (Sutherland and Hodgman
// 1974, "Reentrant Polygon Clipping").
void cut(std::vector<glm::dvec3>& polygon, const glm::dvec4& side, std::vector<glm::dvec3>& kept) {
    kept.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &here = polygon[i], &next = polygon[(i + 1) % polygon.size()];
        const double a = glm::dot(side, glm::dvec4(here, 1)), b = glm::dot(side, glm::dvec4(next, 1));
        if (a >= 0) kept.push_back(here);
        if ((a < 0) != (b < 0)) kept.push_back(glm::mix(here, next, a / (a - b)));
    }
    std::swap(polygon, kept);
}

// Visits the triangles clipped to the view.
template <class Visit>
void eachSeen(const BlendedReceivers& blended, const Visit& visit) {
    const glm::dmat4 rows = glm::transpose(blended.view.clipFromWorld());
    const std::array sides{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                           rows[3] - rows[1], rows[3] - rows[2], rows[2]};
    std::vector<glm::dvec3> polygon, spare;
    for (const DrawItem& item : blended.draws.transparent()) {
        if (item.sides == Sides::back) continue;  // front faces, in the same list, have the same triangles
        const PlacedTriangles of =
            blended.geometry.triangles(blended.pose, blended.pose.instances[item.instance]);
        glm::dmat4 fromObject = of.world_from_object;
        fromObject[3] -= glm::dvec4(blended.view.eye(), 0);
        for (std::size_t i = 0; i + 2 < of.rest.indices.size(); i += 3) {
            polygon.clear();
            for (std::size_t c = i; c < i + 3; ++c)
                polygon.emplace_back(fromObject * glm::dvec4(of.corner(c), 1));
            if (std::ranges::any_of(polygon, [](const glm::dvec3& p) { return std::isnan(p.x); })) continue;
            for (const glm::dvec4& side : sides) cut(polygon, side, spare);
            for (std::size_t c = 2; c < polygon.size(); ++c)
                visit(Corners{polygon[0], polygon[c - 1], polygon[c]});
        }
    }
}

class Marker {
public:
    Marker(const Clipmap& clipmap, const glm::dvec3& eye, std::span<gpu::uint> marks)
        : clipmap_(clipmap), eye_(eye), marks_(marks) {}

    void mark(const Corners& corners) {
        const glm::dvec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        double radius = 0;
        for (const glm::dvec3& corner : corners) radius = std::max(radius, glm::distance(corner, centre));
        const double away = glm::distance(centre + eye_, clipmap_.centre);
        const std::size_t finest = levelAt((away - radius) * (1 - rounding)),
                          coarsest = levelAt((away + radius) * (1 + rounding));
        if (radius > sideOf(finest) / 4 && !(finest == coarsest && pages(corners, finest).size() == 1)) {
            halve(corners);
            return;
        }
        for (std::size_t level = finest; level <= coarsest; ++level)
            for (const std::size_t page : pages(corners, level))
                marks_[page / 32] |= gpu::uint{1} << (page % 32);
    }

private:
    // Far above the float32 rounding of a distance.
    static constexpr double rounding = 1e-5;

    double sideOf(std::size_t level) const { return clipmap_.levels[level].area.texel * clipmap_.grid.page; }

    // As in shaders/lib/shadows/clipmap.glsl.
    std::size_t levelAt(double distance) const {
        const double octaves = std::ceil(std::log2(std::max(distance, 0.0) / clipmap_.levels[0].area.end));
        return static_cast<std::size_t>(
            std::clamp(octaves, 0.0, static_cast<double>(clipmap_.levels.size() - 1)));
    }

    // Indices of pages that overlap the triangle's box in light space.
    const std::vector<std::size_t>& pages(const Corners& corners, std::size_t level) {
        pages_.clear();
        const bool whole = level + 1 == clipmap_.levels.size();
        glm::dvec2 min(std::numeric_limits<double>::infinity()), max(-min);
        for (const glm::dvec3& corner : corners) {
            const glm::dvec2 at =
                (glm::dvec2(clipmap_.grid.space.from(corner + eye_)) - clipmap_.levels[level].area.corner) /
                sideOf(level);
            min = glm::min(min, at - room);
            max = glm::max(max, at + room);
        }
        const double last = whole ? 0 : clipmap_.width - 1;
        const glm::ivec2 first(glm::clamp(glm::floor(min), 0.0, last)),
            end(glm::clamp(glm::floor(max), 0.0, last));
        for (int y = first.y; y <= end.y; ++y)
            for (int x = first.x; x <= end.x; ++x) pages_.push_back(clipmap_.numberOf({level, x, y}));
        return pages_;
    }

    // Splits the triangle at its longest edge.
    void halve(const Corners& c) {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (glm::distance(c[i], c[(i + 1) % 3]) > glm::distance(c[longest], c[(longest + 1) % 3]))
                longest = i;
        const glm::dvec3 &a = c[longest], &b = c[(longest + 1) % 3], &apex = c[(longest + 2) % 3],
                         middle = (a + b) / 2.0;
        mark({a, middle, apex});
        mark({middle, b, apex});
    }

    static constexpr double room = 1e-3;  // pages; bound of float32 rounding of a position in a page

    const Clipmap& clipmap_;
    const glm::dvec3 eye_;
    std::span<gpu::uint> marks_;
    std::vector<std::size_t> pages_;
};

}  // namespace

std::optional<DepthRange> BlendedReceivers::depths() const {
    const glm::dvec3 forward = -view.backward();
    std::optional<DepthRange> range;
    eachSeen(*this, [&](const Corners& corners) {
        for (const glm::dvec3& corner : corners) {
            const double depth = glm::dot(forward, corner);
            range = united(range, DepthRange{depth, depth});
        }
    });
    return range;
}

void BlendedReceivers::mark(const Clipmap& clipmap, std::span<gpu::uint> marks) const {
    Marker marker(clipmap, view.eye(), marks);
    eachSeen(*this, [&](const Corners& corners) { marker.mark(corners); });
}

std::optional<DepthRange> united(const std::optional<DepthRange>& a, const std::optional<DepthRange>& b) {
    if (!a || !b) return a ? a : b;
    return DepthRange{std::min(a->near, b->near), std::max(a->far, b->far)};
}

}  // namespace diptych
