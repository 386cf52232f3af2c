// SPDX-License-Identifier: MIT
#include "shared/shadow/receivers.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace diptych {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
// Margin for float32 rounding of view depths, the image's extent and the map's depth range.
constexpr double rounding = 1e-5;
// The same for positions, relative to their distance from the camera: twice ShadowLight::rounding.
constexpr double positions = 1e-6;

// Corners of the view between two depths, slightly enlarged, in world axes relative to the eye.
std::array<glm::dvec3, 8> sliceOf(const View& view, const DepthRange& depths) {
    const double aspect = static_cast<double>(view.width) / view.height;
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double depth = i & 1 ? depths.far : depths.near;
        const double side =
            view.camera.orthographic ? view.camera.ymag : depth * std::tan(view.camera.yfov / 2);
        const double x = side * aspect * (1 + rounding), y = side * (1 + rounding);
        corners[i] =
            -view.backward() * depth + view.right() * (i & 2 ? x : -x) + view.up() * (i & 4 ? y : -y);
    }
    return corners;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// Convex hull, counter-clockwise (monotone chain, Andrew 1979).
std::vector<glm::dvec2> hullOf(std::array<glm::dvec2, 8> points) {
    std::ranges::sort(points, [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    std::vector<glm::dvec2> hull;
    const auto chain = [&](const auto& range) {
        const std::size_t min = hull.size() + 2;
        for (const glm::dvec2& point : range) {
            while (hull.size() >= min && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
    };
    chain(points);
    std::ranges::reverse(points);
    chain(points);
    return hull;
}

// Whether a square of half side `half` around `centre` is outside one edge of the hull.
bool beside(const std::vector<glm::dvec2>& hull, const glm::dvec2& centre, double half) {
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const double extent = half * (std::abs(edge.x) + std::abs(edge.y));
        if (cross(edge, centre - hull[i]) < -extent) return true;
    }
    return false;
}

struct CellRange {
    int begin = 0, end = 0;
};
// Cells that an interval of clip space overlaps.
CellRange cellsOf(double low, double high) {
    const double count = ReceiverMask::cells;
    const auto at = [count](double clip) { return std::clamp((clip + 1) / 2 * count, -1.0, count); };
    return {std::max(static_cast<int>(std::floor(at(low))), 0),
            std::min(static_cast<int>(std::floor(at(high))) + 1, ReceiverMask::cells)};
}

}  // namespace

ReceiverMask::ReceiverMask(const Cascades& cascades, const CascadeArea& area, const View& view,
                           std::span<const VisibleBox> seen, const CascadeRequest& request, bool compares)
    : size_(request.size), deepest_(std::size_t{cells} * cells, unbounded) {
    // In shaders, too, the first cascade covers everything nearer.
    const bool first = &area == &cascades.areas.front();
    const DepthRange depths{first ? 0 : area.begin * (1 - rounding), area.end * (1 + rounding)};
    const glm::dmat4 clip = cascades.clipFromWorld(area, request.size, view.eye());
    const glm::dvec3 x(clip[0].x, clip[1].x, clip[2].x), y(clip[0].y, clip[1].y, clip[2].y),
        z(clip[0].z, clip[1].z, clip[2].z), origin(clip[3]);
    std::array<glm::dvec2, 8> corners;
    const std::array<glm::dvec3, 8> slice = sliceOf(view, depths);
    double farthest = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = glm::dvec2(glm::dot(x, slice[i]), glm::dot(y, slice[i])) + glm::dvec2(origin);
        farthest = std::max(farthest, glm::length(slice[i]));
    }
    margin_ = 2 * marginOf(request) / request.size + positions * farthest * glm::length(x);
    const double deeper = rounding + positions * farthest * glm::length(z);
    const std::vector<glm::dvec2> hull = hullOf(corners);
    std::vector<bool> seenThere(deepest_.size());
    constexpr double side = 2.0 / cells;
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column)
            seenThere[static_cast<std::size_t>(row * cells + column)] =
                !beside(hull, {(column + 0.5) * side - 1, (row + 0.5) * side - 1}, side / 2 * (1 + rounding));

    const glm::dvec3 forward = -view.backward();
    for (const VisibleBox& box : seen) {
        const double depth = glm::dot(forward, box.centre), extent = box.halfExtent(forward);
        if (depth - extent > depths.far || depth + extent < depths.near) continue;
        const double atX = glm::dot(x, box.centre) + origin.x, byX = box.halfExtent(x);
        const double atY = glm::dot(y, box.centre) + origin.y, byY = box.halfExtent(y);
        const double min =
            compares ? glm::dot(z, box.centre) + origin.z - box.halfExtent(z) - deeper : -unbounded;
        const CellRange columns = cellsOf(atX - byX, atX + byX), rows = cellsOf(atY - byY, atY + byY);
        for (int row = rows.begin; row < rows.end; ++row)
            for (int column = columns.begin; column < columns.end; ++column) {
                const auto cell = static_cast<std::size_t>(row * cells + column);
                if (seenThere[cell]) deepest_[cell] = std::min(deepest_[cell], min);
            }
    }
}

bool ReceiverMask::reachedBy(const ClipBox& caster) const {
    const CellRange columns = cellsOf(caster.min.x - margin_, caster.max.x + margin_),
                    rows = cellsOf(caster.min.y - margin_, caster.max.y + margin_);
    for (int row = rows.begin; row < rows.end; ++row)
        for (int column = columns.begin; column < columns.end; ++column)
            if (deepest(column, row) <= caster.max.z) return true;
    return false;
}

ReceiverMask::Texels ReceiverMask::read() const {
    CellRange columns{cells, 0}, rows{cells, 0};
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            if (deepest(column, row) == unbounded) continue;
            columns = {std::min(columns.begin, column), std::max(columns.end, column + 1)};
            rows = {std::min(rows.begin, row), std::max(rows.end, row + 1)};
        }
    if (rows.begin >= rows.end) return {};
    const double texels = size_ / cells, around = margin_ / 2 * size_;
    const auto first = [&](int cell) {
        return static_cast<int>(std::max(std::floor(cell * texels - around), 0.0));
    };
    const auto end = [&](int cell) {
        return static_cast<int>(std::min(std::ceil(cell * texels + around), size_));
    };
    return {first(columns.begin), first(rows.begin), end(columns.end) - first(columns.begin),
            end(rows.end) - first(rows.begin)};
}

}  // namespace diptych
