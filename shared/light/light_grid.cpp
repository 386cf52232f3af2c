// SPDX-License-Identifier: MIT
#include "shared/light/light_grid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace diptych {

namespace {

// Bound of float32 rounding between a light's bound and the pixels it lights: about a dozen roundings on
// each side, each 6e-8 of the distance from the camera.
constexpr double radius_rounding = 4e-6;

// Coarsest slices that are tried, log2: four per octave of depth + offset, so a slice's depth range is an
// eighth to a quarter of its distance.
constexpr gpu::uint octaveShift = 23 - 2;
constexpr gpu::uint maxSlices = 128;
constexpr gpu::uint finestTile = 3, coarsestTile = 6;  // pixels, log2
// Keeps the loops of the LIGHT_THREADS threads of a light that reaches all cells far below lavapipe's
// limit.
constexpr std::uint64_t maxCells = 131072;
static_assert(maxCells / gpu::LIGHT_THREADS < 65535 / 2);

double middle(std::vector<double> values, double otherwise) {
    if (values.empty()) return otherwise;
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
}

gpu::uint tilesAcross(int pixels, gpu::uint shift) {
    return (static_cast<gpu::uint>(pixels) + (1u << shift) - 1) >> shift;
}

struct TypicalLight {
    double radius = 1;  // m
    double depth = 1;   // m
    double far = 0;     // largest depth that a light reaches, m
};

// Median of the finite lights in front of the camera.
TypicalLight typicalLight(std::span<const gpu::LightBound> bounds) {
    std::vector<double> radii, depths;
    TypicalLight light;
    for (const gpu::LightBound& b : bounds) {
        const double r = double{b.radius}, z = double{b.centre.z};
        if (r >= 1e6 || z + r <= 0) continue;
        radii.push_back(r);
        depths.push_back(std::max(z, r));
        light.far = std::max(light.far, z + r);
    }
    light.radius = std::max(middle(std::move(radii), 1), 1e-6);
    light.depth = middle(std::move(depths), 1);
    return light;
}

gpu::uint sliceOf(const gpu::LightGrid& grid, double depth) {
    const float sum = static_cast<float>(std::max(depth, 0.0)) + grid.slice_offset;
    return (std::bit_cast<gpu::uint>(sum) - std::bit_cast<gpu::uint>(grid.slice_offset)) >> grid.slice_shift;
}

void sizeTiles(gpu::LightGrid& grid, const View& view, gpu::uint shift) {
    grid.tile_shift = shift;
    grid.tiles = {tilesAcross(view.width, shift), tilesAcross(view.height, shift)};
}

// Volume, m^3, of the positions of a cell's centre at which the typical light reaches the cell: the
// Minkowski sum of a box and a sphere, by Steiner's formula.
double reachVolume(const gpu::LightGrid& grid, bool orthographic, const TypicalLight& light) {
    const double r = light.radius, depth = light.depth + double{grid.slice_offset};
    const double side =
        double{grid.pixel} * (orthographic ? 1 : light.depth) * static_cast<double>(1u << grid.tile_shift);
    // Average over the first and last slice of an octave.
    const double deep = 0.75 * depth / static_cast<double>(1u << (23 - std::min(grid.slice_shift, 23u)));
    return side * side * deep + 2 * (side * side + 2 * side * deep) * r +
           std::numbers::pi * (2 * side + deep) * r * r + 4 * std::numbers::pi / 3 * r * r * r;
}

// Chooses tile and slice sizes that minimize the total cost of list building and shading. The number of
// lights per cell is estimated for one grid and scaled to others by reachVolume().
void sizeFroxels(gpu::LightGrid& grid, const View& view, std::span<const gpu::LightBound> bounds,
                 const DeviceCosts& costs, std::uint64_t max) {
    const bool orthographic = view.camera.orthographic;
    const TypicalLight typical = typicalLight(bounds);
    grid.slice_offset = static_cast<float>(2 * typical.radius);
    const double far = std::min(typical.far, view.camera.far);
    const auto sized = [&](gpu::uint tile, gpu::uint slice) {
        gpu::LightGrid g = grid;
        sizeTiles(g, view, tile);
        g.slice_shift = slice;
        g.slices = sliceOf(g, far) + 1;
        return g;
    };
    const auto cells = [](const gpu::LightGrid& g) {
        return std::uint64_t{g.tiles.x} * g.tiles.y * g.slices;
    };
    gpu::uint coarsest = octaveShift;
    while (sized(coarsestTile, coarsest).slices > std::min<std::uint64_t>(maxSlices, max)) ++coarsest;
    grid = sized(coarsestTile, coarsest);
    while (cells(grid) > max) grid = sized(grid.tile_shift + 1, coarsest);
    const gpu::uint largest = grid.tile_shift;
    const double pixels = static_cast<double>(view.width) * view.height;
    const double lights = static_cast<double>(listedAtMost(grid, orthographic, bounds)) /
                          (static_cast<double>(cells(grid)) * reachVolume(grid, orthographic, typical));
    double min = std::numeric_limits<double>::infinity();
    for (gpu::uint tile = finestTile; tile <= largest; ++tile)
        for (gpu::uint slice = coarsest + 1; slice-- > 0;) {
            const gpu::LightGrid g = sized(tile, slice);
            if (g.slices > maxSlices || cells(g) > max) break;
            const double listed = lights * reachVolume(g, orthographic, typical);
            const double cost = static_cast<double>(cells(g)) * (costs.list + listed * costs.listed) +
                                pixels * listed * costs.evaluated;
            if (cost < min) {
                min = cost;
                grid = g;
            }
        }
}

}  // namespace

std::vector<gpu::LightBound> lightBounds(const GpuLights& lights, const View& view) {
    const glm::dvec3 right = view.right(), down = -view.up(), forward = -view.backward();
    const auto toView = [&](const glm::vec3& v) {
        const glm::dvec3 d(v);
        return glm::dvec3(glm::dot(d, right), glm::dot(d, down), glm::dot(d, forward));
    };
    std::vector<gpu::LightBound> bounds;
    bounds.reserve(lights.local());
    for (std::size_t i = lights.directional; i < lights.directional + lights.local(); ++i) {
        const gpu::Light& light = lights.lights[i];
        const glm::dvec3 apex = toView(light.position);
        glm::dvec3 centre = apex, axis(0, 0, 1);
        double radius = double{light.range}, cosCone = -1, sinCone = 0;
        if (const gpu::SpotCone* cone = lights.coneOf(i)) {
            axis = toView(cone->direction);
            // The shader rounds offset + scale * cos, so a spot may light slightly outside its cone.
            cosCone = std::clamp(double{-cone->offset / cone->scale} - 2e-6, -1.0, 1.0);
            sinCone = std::sqrt(1 - cosCone * cosCone);
            // Smallest bounding sphere of the spot's spherical sector.
            if (std::isfinite(radius) && cosCone > 0) {
                const double along = cosCone > std::sqrt(0.5) ? radius / (2 * cosCone) : radius * cosCone;
                centre = apex + axis * along;
                radius = cosCone > std::sqrt(0.5) ? along : radius * sinCone;
            }
        }
        radius += radius_rounding * (radius + glm::length(apex));
        if (radius >= double{gpu::MAX_BOUND_RADIUS}) centre = glm::dvec3(0);
        bounds.push_back({.centre = gpu::vec3(centre),
                          .radius = static_cast<float>(std::min(radius, double{gpu::MAX_BOUND_RADIUS})),
                          .apex = gpu::vec3(apex),
                          .cos_cone = static_cast<float>(cosCone),
                          .axis = gpu::vec3(axis),
                          .sin_cone = static_cast<float>(sinCone)});
    }
    return bounds;
}

gpu::uint cellOf(const gpu::LightGrid& grid, int x, int y, float depth) {
    const gpu::uint column = static_cast<gpu::uint>(x) >> grid.tile_shift,
                    row = static_cast<gpu::uint>(y) >> grid.tile_shift;
    const gpu::uint slice = std::min(sliceOf(grid, double{depth}), grid.slices - 1);
    return (slice * grid.tiles.y + row) * grid.tiles.x + column;
}

SliceDepths sliceDepths(const gpu::LightGrid& grid, gpu::uint s) {
    const auto depthOf = [&](gpu::uint slice) {
        return std::bit_cast<float>(std::bit_cast<gpu::uint>(grid.slice_offset) +
                                    (slice << grid.slice_shift));
    };
    const float near = depthOf(s), far = depthOf(s + 1);
    constexpr float slack = 1e-6f;
    return {s == 0 ? 0 : near - grid.slice_offset - slack * near,
            s + 1 == grid.slices ? gpu::MAX_BOUND_RADIUS : far - grid.slice_offset + slack * far};
}

std::uint64_t listedAtMost(const gpu::LightGrid& grid, bool orthographic,
                           std::span<const gpu::LightBound> bounds) {
    // Tiles along one axis that the interval [lo, hi] touches at depths [near, far], plus one on either
    // side.
    const auto tiles = [&](double lo, double hi, double near, double far, float centre, gpu::uint count) {
        const double from = orthographic ? lo : lo / (lo < 0 ? near : far);
        const double to = orthographic ? hi : hi / (hi < 0 ? far : near);
        const double side = double{grid.pixel} * static_cast<double>(1u << grid.tile_shift);
        const double middle = double{centre} / static_cast<double>(1u << grid.tile_shift);
        const double first =
            std::clamp(std::floor(from / side + middle) - 1, 0.0, static_cast<double>(count));
        const double last = std::clamp(std::floor(to / side + middle) + 2, 0.0, static_cast<double>(count));
        return static_cast<std::uint64_t>(std::max(last - first, 0.0));
    };
    std::uint64_t pairs = 0;
    for (const gpu::LightBound& b : bounds) {
        const double r = double{b.radius}, x = double{b.centre.x}, y = double{b.centre.y},
                     z = double{b.centre.z};
        if (z + r < 0) continue;
        const gpu::uint first = std::min(sliceOf(grid, z - r), grid.slices - 1);
        const gpu::uint last = std::min(sliceOf(grid, z + r), grid.slices - 1);
        for (gpu::uint s = first; s <= last; ++s) {
            const SliceDepths slab = sliceDepths(grid, s);
            const double near = std::max({double{slab.near}, z - r, 1e-30});
            const double far = std::max(near, std::min(double{slab.far}, z + r));
            const double dz = std::max({near - z, z - far, 0.0});
            const double cut = std::sqrt(std::max(r * r - dz * dz, 0.0));
            pairs += tiles(x - cut, x + cut, near, far, grid.centre.x, grid.tiles.x) *
                     tiles(y - cut, y + cut, near, far, grid.centre.y, grid.tiles.y);
        }
    }
    return pairs;
}

gpu::LightGrid makeLightGrid(const GridLists& of, const View& view, const GpuLights& lights,
                             std::span<const gpu::LightBound> bounds, const DeviceCosts& costs,
                             std::uint64_t buffer_bytes) {
    gpu::LightGrid grid{};
    const double half = view.camera.orthographic ? view.camera.ymag : std::tan(view.camera.yfov / 2);
    grid.pixel = static_cast<float>(2 * half / view.height);
    grid.centre = {0.5f * static_cast<float>(view.width), 0.5f * static_cast<float>(view.height)};
    grid.local_lights = static_cast<gpu::uint>(bounds.size());
    grid.first_local = lights.directional;
    grid.point_end = lights.point;
    grid.spot_end = lights.point + lights.spot;
    grid.words = (grid.local_lights + 31) / 32;
    grid.segments = (grid.words + gpu::SEGMENT_WORDS - 1) / gpu::SEGMENT_WORDS;
    grid.slices = 1;
    if (of.lists == gpu::LISTS_CLUSTERED)
        sizeFroxels(grid, view, bounds, costs,
                    std::min(maxCells, buffer_bytes / (4 * std::max(grid.words, 1u))));
    else
        sizeTiles(grid, view, std::bit_width(gpu::LIGHT_TILE) - 1);
    const auto count = [&] {
        grid.lists = grid.tiles.x * grid.tiles.y * grid.slices * (of.in_front ? 2 : 1);
        grid.list_stride = (grid.lists + 3) / 4 * 4;
        return std::uint64_t{grid.list_stride};
    };
    // The masks' rows, and those of the candidates per tile and slice.
    const auto longestRow = [&] {
        return std::max(count(), std::uint64_t{grid.tiles.x} * grid.tiles.y + grid.slices);
    };
    while (longestRow() * grid.words * 4 > buffer_bytes || count() > maxCells)
        sizeTiles(grid, view, grid.tile_shift + 1);
    const std::uint64_t pairs = listedAtMost(grid, view.camera.orthographic, bounds) * (of.in_front ? 2 : 1);
    // An entry of four lights costs as much as three entries of one, so wide entries suit long lists.
    grid.width = pairs > 8 * std::uint64_t{grid.lists} ? 4 : 1;
    grid.null_light = static_cast<gpu::uint>(lights.lights.size()) - 1;
    const auto entries = [&](gpu::uint ofLights) { return (ofLights + grid.width - 1) / grid.width; };
    grid.all_point_end = entries(grid.point_end);
    grid.all_spot_end = grid.all_point_end + entries(grid.spot_end - grid.point_end);
    grid.all_end = grid.all_spot_end + entries(grid.local_lights - grid.spot_end);
    const std::uint64_t kinds =
        (grid.point_end > 0) + (grid.spot_end > grid.point_end) + (grid.local_lights > grid.spot_end);
    // The last entry of each light type may be partly filled.
    const std::uint64_t wanted = grid.all_end + pairs / grid.width + kinds * grid.lists;
    grid.capacity = static_cast<gpu::uint>(std::min(wanted, buffer_bytes / (4 * grid.width)));
    return grid;
}

}  // namespace diptych
