// SPDX-License-Identifier: MIT
#include "compare/verdict/surface_pixels.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/device_bounds.h"
#include "compare/verdict/surface_grid.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

namespace diptych {
namespace {

// Moving a vertex by one subpixel step moves an edge by as much, and this fraction of the pixels on the
// edge changes sides. A pixel beside an edge lies between two edges of a triangle; if its triangle is
// narrower than two pixels, between twice as many.
constexpr double edgesOfPixel = 2;
constexpr std::uint64_t fewPixels = 8;  // chance decides about so few

// Whether a pixel is beside another surface or another triangle's plane.
bool isBesideEdge(const SurfaceAround& frame, const Image& ids, const Image* normals, std::size_t i,
                  double facet) {
    bool found = false;
    aroundPixel(ids, i, [&](std::size_t j, unsigned) {
        found = found || !frame.same(i, j) ||
                (normals && metrics::angle(normals->pixel(i), normals->pixel(j)) > facet);
    });
    return found;
}

// Whether texture coordinates jump beside a pixel: they change far more to one side than to the other.
bool isBesideSeam(const Image& uv, std::size_t i) {
    constexpr double even = 4;
    const auto width = static_cast<std::size_t>(uv.width);
    const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
        if (x < 1 || y < 1 || x + 1 >= uv.width || y + 1 >= uv.height) return true;
        const double a = metrics::distance(uv.pixel(indexOf(uv, x + dx, y + dy)), uv.pixel(i), 2),
                     b = metrics::distance(uv.pixel(indexOf(uv, x - dx, y - dy)), uv.pixel(i), 2);
        if (std::max(a, b) > even * std::min(a, b) + 1e-5) return true;
    }
    return false;
}

// Counts pixels that differ, and records where they must not.
void count(SurfacePixels::Differing& of, std::size_t i, int width, bool differs, bool edge) {
    of.edges += edge;
    of.count += differs;
    if (!differs || edge || of.strays++ > 0) return;
    of.x = static_cast<int>(i % static_cast<std::size_t>(width));
    of.y = static_cast<int>(i / static_cast<std::size_t>(width));
}

std::uint64_t mostOf(double share, std::uint64_t edges) {
    return std::max(fewPixels, static_cast<std::uint64_t>(std::min(1.0, share) * static_cast<double>(edges)));
}

}  // namespace

std::vector<int> surfacePixelChannels() {
    return {static_cast<int>(gpu::DEBUG_material_id), static_cast<int>(gpu::DEBUG_depth),
            static_cast<int>(gpu::DEBUG_position), static_cast<int>(gpu::DEBUG_geometric_normal)};
}

SurfacePixels surfacePixels(const FramePair& pair) {
    SurfacePixels found;
    found.others.assign(pair.coverage.covered.size(), 0);
    const auto both = [&](gpu::uint mode) {
        return std::array{findChannel(pair.baseline, mode), findChannel(pair.test, mode)};
    };
    const auto [a, b] = both(gpu::DEBUG_material_id);
    const auto [n, m] = both(gpu::DEBUG_geometric_normal);
    const auto [z, w] = both(gpu::DEBUG_depth);
    const auto [p, q] = both(gpu::DEBUG_position);
    const auto [u, v] = pair.across->texcoords;
    if (!a || !b) return found;
    const std::array sides{SurfaceAround(pair.baseline), SurfaceAround(pair.test)};
    const FacetBound facetOf(pair);
    std::optional<DeviceBounds> depth;
    if (z && w) depth.emplace(debugMode(gpu::DEBUG_depth), pair);
    std::optional<PlaceBound> coordinates;
    const DebugMode& texcoords = debugMode(gpu::DEBUG_texcoords);
    if (u && v) coordinates.emplace(texcoords, pair, *u, *v);
    const Shadowed shadowed(pair);
    std::optional<DeviceBounds> light;
    if (findChannel(pair.baseline, gpu::DEBUG_lit) && findChannel(pair.test, gpu::DEBUG_lit) &&
        pair.across->relit.contains(gpu::DEBUG_lit))
        light.emplace(debugMode(gpu::DEBUG_lit), pair);
    const double step = stepOf(*pair.across, &DevicePrecision::sub_pixel_bits);
    // How far from a position another surface of equal depth may lie, m.
    const auto tieReach = [&](std::size_t i) {
        return *z->pixel(i) * (step / pixelsPerRadian(pair.baseline, i) + relativeRounding());
    };
    std::uint64_t narrow = 0;
    for (std::size_t i = 0; i < found.others.size(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const double facet = facetOf(i);
        const bool edge = isBesideEdge(sides[0], *a, n, i, facet) ||
                          isBesideEdge(sides[1], *b, m, i, facet) ||
                          (coordinates && (isBesideSeam(*u, i) || isBesideSeam(*v, i)));
        const bool material = *a->pixel(i) != *b->pixel(i),
                   place = (n && m && metrics::angle(n->pixel(i), m->pixel(i)) > facet) ||
                           (depth && !(depth->error(i) <= (*depth)(i))),
                   seam = coordinates &&
                          !(apart(texcoords, u->pixel(i), v->pixel(i)) <=
                            (*coordinates)(i) +
                                relativeRounding() * std::max(1.0, metrics::largestFinite(u->pixel(i), 2)));
        const bool other = material || place || seam;
        if (other && !place && p && q && z && pair.across->surface_at) {
            const double near = tieReach(i);
            const auto isThere = [&](const Image& ids, const Image& places) {
                return *ids.pixel(i) >= 0 && pair.across->surface_at(static_cast<int>(*ids.pixel(i)),
                                                                     places.pixel(i), near, !material);
            };
            if (isThere(*a, *p) && isThere(*b, *q)) {
                found.others[i] = 1;
                ++found.tied;
                continue;
            }
        }
        if (!other && light && p && z && pair.across->surface_at && light->blendedApart(i) > 0 &&
            pair.across->surface_at(-1, p->pixel(i), tieReach(i), false)) {
            found.others[i] = 1;
            ++found.tied;
            continue;
        }
        count(found.triangles, i, a->width, other, edge);
        narrow += edge && pair.grid->narrow[i] != 0;
        // A larger difference of light beside a shadow boundary also means another shadow, at the other
        // image's position.
        const bool beside = shadowed.isBesideEdge(i),
                   shade = !other &&
                           (shadowed.differs(i) || (beside && light && !(light->error(i) <= (*light)(i))));
        count(found.shadows, i, a->width, shade, beside);
        found.others[i] = other || shade ? 1 : 0;
    }
    found.triangles.most = mostOf(edgesOfPixel * step, found.triangles.edges + narrow);
    // Each texel of a filter across an edge may show another triangle.
    const double texels = pair.baseline.settings.shadow_kernel + 1;
    found.shadows.most = mostOf(edgesOfPixel * step * texels, found.shadows.edges);
    return found;
}

std::string SurfacePixels::fault() const {
    for (const auto& [of, shows, edge] : {std::tuple{&triangles, "another triangle", "an edge"},
                                          {&shadows, "another shadow", "a shadow boundary"}}) {
        if (of->strays > 0)
            return fmt::format("the other device shows {} at {} not beside {}, the first at {},{}", shows,
                               counted(of->strays, "pixel"), edge, of->x, of->y);
        if (of->count > of->most)
            return fmt::format("the other device shows {} at {}; tolerance: {} of the {} beside {}", shows,
                               counted(of->count, "pixel"), of->most, counted(of->edges, "pixel"), edge);
    }
    return {};
}

std::string SurfacePixels::inWords() const {
    std::string words = fmt::format(
        "not compared: {} where the other device shows another triangle, all beside an edge (tolerance: {} "
        "of {})",
        counted(triangles.count, "pixel"), triangles.most, triangles.edges);
    if (shadows.edges > 0)
        words += fmt::format("; {} in another shadow, all beside a shadow boundary (tolerance: {} of {})",
                             shadows.count, shadows.most, shadows.edges);
    if (tied > 0) words += fmt::format("; {} where two surfaces have the same depth", tied);
    return words;
}

}  // namespace diptych
