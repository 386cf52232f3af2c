// SPDX-License-Identifier: MIT
#include "shared/shadow/clipmap.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace diptych {

namespace {

// Lower bound of a level's texels relative to the scene: float32 rounding of a vertex's position in a
// page, and of a depth, then stays below the bias of half a texel.
constexpr double finestFraction = 2 * double{std::numeric_limits<float>::epsilon()};

// Border around a page, texels: the receiver's offset, the filter's radius, and one for rounding at page
// boundaries.
int gutterOf(const ClipmapRequest& request) {
    const double moved = request.bias + std::numbers::sqrt2 * (request.kernel + 1) / 2.0;
    return static_cast<int>(std::ceil(moved + request.kernel / 2.0 + 2));
}

PageGrid gridOf(const Bounds& bounds, const glm::dvec3& to_light, const ClipmapRequest& request) {
    PageGrid grid{.space = lightSpace(to_light), .page = request.page, .gutter = gutterOf(request)};
    glm::dvec3 min(std::numeric_limits<double>::infinity()), max(-min);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner{(i & 1 ? bounds.max : bounds.min).x, (i & 2 ? bounds.max : bounds.min).y,
                                (i & 4 ? bounds.max : bounds.min).z};
        min = glm::min(min, grid.space.from(corner));
        max = glm::max(max, grid.space.from(corner));
    }
    // Rounds outwards to sixteenths of a power of two, with a margin for rounding errors. So a small
    // movement of a caster does not move other pages.
    const glm::dvec3 extent = max - min;
    const double largest = std::max({extent.x, extent.y, extent.z, 1e-9}), room = 1e-4 * largest;
    const double step = std::exp2(std::ceil(std::log2(largest))) / 16;
    min = glm::floor((min - room) / step) * step;
    max = glm::ceil((max + room) / step) * step;
    grid.near = max.z;
    grid.far = min.z;
    grid.corner = glm::dvec2(min);
    grid.side = std::max(max.x - min.x, max.y - min.y);
    return grid;
}

double distanceTo(const Bounds& bounds, const glm::dvec3& point) {
    return glm::distance(point, glm::clamp(point, bounds.min, bounds.max));
}

double farthestOf(const Bounds& bounds, const glm::dvec3& point) {
    return glm::length(glm::max(glm::abs(bounds.min - point), glm::abs(bounds.max - point)));
}

}  // namespace

CascadeArea PageGrid::areaOf(const PageAddress& address) const {
    const bool whole = address.exponent == PageAddress::whole_scene;
    const double length = whole ? side : std::ldexp(1.0, address.exponent), texel = length / page;
    const glm::dvec2 at =
        whole ? corner : glm::dvec2(static_cast<double>(address.x), static_cast<double>(address.y)) * length;
    return {.corner = at - gutter * texel, .texel = texel};
}

std::size_t Clipmap::pages() const {
    return (levels.size() - 1) * static_cast<std::size_t>(width * width) + 1;
}

Clipmap::Place Clipmap::placeOf(std::size_t page) const {
    const auto side = static_cast<std::size_t>(width);
    return {page / (side * side), static_cast<int>(page % side), static_cast<int>(page / side % side)};
}

std::size_t Clipmap::numberOf(const Place& place) const {
    const auto side = static_cast<std::size_t>(width);
    return (place.level * side + static_cast<std::size_t>(place.y)) * side +
           static_cast<std::size_t>(place.x);
}

PageAddress Clipmap::addressOf(const Place& place) const {
    const ClipmapLevel& level = levels[place.level];
    return {level.exponent, level.first.x + place.x, level.first.y + place.y};
}

Clipmap::Place Clipmap::parentOf(const Place& place) const {
    const std::size_t next = std::min(place.level + 1, levels.size() - 1);
    if (next + 1 == levels.size()) return {next, 0, 0};
    // Arithmetic shift: pages with negative coordinates have parents with negative coordinates.
    const PageAddress address = addressOf(place);
    return {next, static_cast<int>((address.x >> 1) - levels[next].first.x),
            static_cast<int>((address.y >> 1) - levels[next].first.y)};
}

Clipmap fitClipmap(const View& view, const Bounds& bounds, const glm::dvec3& to_light,
                   const ClipmapRequest& request) {
    Clipmap clipmap{.grid = gridOf(bounds, to_light, request)};
    const PageGrid& grid = clipmap.grid;
    double nearest = std::max(view.camera.near, distanceTo(bounds, view.eye()));
    double scene = std::max(grid.side, grid.near - grid.far);
    clipmap.centre = view.eye();
    if (view.camera.orthographic) {
        const double depth = glm::dot(bounds.centre() - view.eye(), -view.backward());
        clipmap.centre -= view.backward() * depth;
        nearest = view.camera.ymag * std::hypot(static_cast<double>(view.width) / view.height, 1);
        scene = std::max(scene, farthestOf(bounds, view.eye()));  // positions are as far from the camera
    }
    const int across = (request.size + request.page - 1) / request.page;
    clipmap.width = across + 1;
    const double finest = std::max(2 * nearest / across, finestFraction * scene * request.page);
    const double farthest = farthestOf(bounds, clipmap.centre);
    const glm::dvec2 centre(grid.space.from(clipmap.centre));
    for (int exponent = static_cast<int>(std::ceil(std::log2(finest)));; ++exponent) {
        const double side = std::ldexp(1.0, exponent), reach = side * across / 2;
        const glm::dvec2 first = glm::floor((centre - reach) / side);
        clipmap.levels.push_back(
            {.exponent = exponent,
             .first = glm::i64vec2(first),
             .area = {.end = reach, .corner = first * side, .texel = side / request.page}});
        // Further levels than requested continue until a few pages cover the scene, so that a small pool
        // falls back gradually.
        if (reach >= farthest && side >= grid.side / 2) break;
    }
    clipmap.levels.push_back({.area = {.end = std::numeric_limits<double>::infinity(),
                                       .corner = grid.corner,
                                       .texel = grid.side / request.page}});
    return clipmap;
}

gpu::Clipmap gpuClipmap(const Clipmap& clipmap, const glm::dvec3& eye) {
    return {.centre = clipmap.centre - eye,
            .levels_from = static_cast<float>(1 / clipmap.levels.front().area.end),
            .levels = static_cast<gpu::uint>(clipmap.levels.size() - 1),
            .width = static_cast<gpu::uint>(clipmap.width),
            .page = static_cast<float>(clipmap.grid.page),
            .spare = 0};
}

Cascades cascadesOf(const Clipmap& clipmap) {
    Cascades cascades{
        .space = clipmap.grid.space, .near = clipmap.grid.near, .far = clipmap.grid.far, .areas = {}};
    for (const ClipmapLevel& level : clipmap.levels) cascades.areas.push_back(level.area);
    return cascades;
}

}  // namespace diptych
