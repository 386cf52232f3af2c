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
#include <cmath>
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

// Whether texture coordinates jump beside a pixel: their second difference over two opposite neighbours
// reaches `jump`. In perspective they are linear in the image after division by `depth`; nullptr:
// orthographic.
bool isBesideSeam(const Image& uv, const Image* depth, std::size_t i, double jump) {
    const auto width = static_cast<std::size_t>(uv.width);
    const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
    if (x < 1 || y < 1 || x + 1 >= uv.width || y + 1 >= uv.height) return true;
    const auto divided = [&](std::size_t j, int c) {
        return double{uv.pixel(j)[c]} * (depth ? double{*depth->pixel(i)} / double{*depth->pixel(j)} : 1);
    };
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
        const std::size_t a = indexOf(uv, x - dx, y - dy), b = indexOf(uv, x + dx, y + dy);
        for (int c = 0; c < 2; ++c)
            if (std::abs(divided(a, c) - 2 * divided(i, c) + divided(b, c)) >= jump) return true;
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

std::uint64_t mostOf(double fraction, std::uint64_t edges) {
    return std::max(fewPixels,
                    static_cast<std::uint64_t>(std::min(1.0, fraction) * static_cast<double>(edges)));
}

using Planes = std::array<const Image*, 2>;  // of baseline and test; null where missing

Planes planesOf(const FramePair& pair, Channel channel) {
    return {findChannel(pair.baseline, channel), findChannel(pair.test, channel)};
}

// Tests whether both devices show the same surface and light at a pixel.
class PixelTest {
public:
    // Both Frames have material_id.
    explicit PixelTest(const FramePair& pair) : pair_(pair) {
        if (depths_[0] && depths_[1]) depth_.emplace(debugMode(Channel::depth), pair);
        if (uvs_[0] && uvs_[1]) coordinates_.emplace(texcoords_, pair, *uvs_[0], *uvs_[1]);
        if (findChannel(pair.baseline, Channel::lit) && findChannel(pair.test, Channel::lit) &&
            pair.across->relit.contains(Channel::lit))
            light_.emplace(debugMode(Channel::lit), pair);
    }

    struct Result {
        bool edge = false;  // beside another surface, another triangle's plane or a seam, in either image
        bool material = false, position = false, seam = false;  // which of them differs
        bool isOther() const { return material || position || seam; }
    };
    Result operator()(std::size_t i) const {
        const double facet = facetOf_(i);
        Result result;
        result.edge = isBesideEdge(sides_[0], *ids_[0], normals_[0], i, facet) ||
                      isBesideEdge(sides_[1], *ids_[1], normals_[1], i, facet);
        result.material = *ids_[0]->pixel(i) != *ids_[1]->pixel(i);
        result.position = (normals_[0] && normals_[1] &&
                           metrics::angle(normals_[0]->pixel(i), normals_[1]->pixel(i)) > facet) ||
                          (depth_ && !(depth_->error(i) <= (*depth_)(i)));
        if (!coordinates_) return result;
        const double bound = (*coordinates_)(i) +
                             relativeRounding() * std::max(1.0, metrics::largestFinite(uvs_[0]->pixel(i), 2));
        result.seam = !(channelDifference(texcoords_, uvs_[0]->pixel(i), uvs_[1]->pixel(i)) <= bound);
        // A sub-pixel step causes at most half the bound (kink), so a seam has caused the other half.
        for (const std::size_t side : {0, 1})
            result.edge = result.edge ||
                          isBesideSeam(*uvs_[side], perspective_ ? depths_[side] : nullptr, i, bound / 2);
        return result;
    }

    // Whether two surfaces have the same depth there, so that either may be visible or blended first.
    bool isTied(std::size_t i, const Result& result) const {
        const auto& surface_at = pair_.across->surface_at;
        if (!positions_[0] || !depths_[0] || !surface_at) return false;
        if (!result.isOther())
            return light_ && light_->blendedDifference(i) > 0 &&
                   surface_at(-1, positions_[0]->pixel(i), tieTolerance(i), false);
        if (result.position || !positions_[1]) return false;
        const double near = tieTolerance(i);
        const auto isThere = [&](const Image& ids, const Image& positions) {
            return *ids.pixel(i) >= 0 &&
                   surface_at(static_cast<int>(*ids.pixel(i)), positions.pixel(i), near, !result.material);
        };
        return isThere(*ids_[0], *positions_[0]) && isThere(*ids_[1], *positions_[1]);
    }

    bool isBesideShadowEdge(std::size_t i) const { return shadowed_.isBesideEdge(i); }
    // A larger difference of light beside a shadow boundary also means another shadow, at the other image's
    // position.
    bool showsOtherShadow(std::size_t i, bool beside) const {
        return shadowed_.differs(i) || (beside && light_ && !(light_->error(i) <= (*light_)(i)));
    }

private:
    // How far from a position another surface of equal depth may lie, m.
    double tieTolerance(std::size_t i) const {
        return *depths_[0]->pixel(i) * (step_ / pixelsPerRadian(pair_.baseline, i) + relativeRounding());
    }

    const FramePair& pair_;
    const Planes ids_ = planesOf(pair_, Channel::material_id),
                 normals_ = planesOf(pair_, Channel::geometric_normal),
                 depths_ = planesOf(pair_, Channel::depth), positions_ = planesOf(pair_, Channel::position);
    const Planes uvs_ = pair_.across->texcoords;
    const bool perspective_ = pair_.baseline.camera.fov_degrees > 0;
    const DebugMode& texcoords_ = debugMode(Channel::texcoords);
    const std::array<SurfaceAround, 2> sides_{SurfaceAround(pair_.baseline), SurfaceAround(pair_.test)};
    const FacetBound facetOf_{pair_};
    const Shadowed shadowed_{pair_};
    std::optional<DeviceBounds> depth_, light_;
    std::optional<PixelBound> coordinates_;
    const double step_ = stepOf(pair_.across->devices, &DevicePrecision::sub_pixel_bits);
};

}  // namespace

std::vector<Channel> surfacePixelChannels() {
    return {Channel::material_id, Channel::depth, Channel::position, Channel::geometric_normal};
}

SurfacePixels surfacePixels(const FramePair& pair) {
    SurfacePixels found;
    found.others.assign(pair.coverage.covered.size(), 0);
    const auto [ids, other_ids] = planesOf(pair, Channel::material_id);
    if (!ids || !other_ids) return found;
    const PixelTest test(pair);
    std::uint64_t narrow = 0;
    for (std::size_t i = 0; i < found.others.size(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const PixelTest::Result result = test(i);
        if (test.isTied(i, result)) {
            found.others[i] = 1;
            ++found.tied;
            continue;
        }
        const bool other = result.isOther();
        count(found.triangles, i, ids->width, other, result.edge);
        narrow += result.edge && pair.grid->narrow[i] != 0;
        const bool beside = test.isBesideShadowEdge(i), shade = !other && test.showsOtherShadow(i, beside);
        count(found.shadows, i, ids->width, shade, beside);
        found.others[i] = other || shade ? 1 : 0;
    }
    const double step = stepOf(pair.across->devices, &DevicePrecision::sub_pixel_bits);
    found.triangles.max = mostOf(edgesOfPixel * step, found.triangles.edges + narrow);
    // Each texel of a filter across an edge may show another triangle.
    const double texels = pair.baseline.settings.shadow_kernel + 1;
    found.shadows.max = mostOf(edgesOfPixel * step * texels, found.shadows.edges);
    return found;
}

std::string SurfacePixels::fault() const {
    for (const auto& [of, shows, edge] : {std::tuple{&triangles, "another triangle", "an edge"},
                                          {&shadows, "another shadow", "a shadow boundary"}}) {
        if (of->strays > 0)
            return fmt::format("the other device shows {} at {} not beside {}, the first at {},{}", shows,
                               counted(of->strays, "pixel"), edge, of->x, of->y);
        if (of->count > of->max)
            return fmt::format("the other device shows {} at {}; tolerance: {} of the {} beside {}", shows,
                               counted(of->count, "pixel"), of->max, counted(of->edges, "pixel"), edge);
    }
    return {};
}

std::string SurfacePixels::describe() const {
    std::string text = fmt::format(
        "not compared: {} where the other device shows another triangle, all beside an edge (tolerance: {} "
        "of {})",
        counted(triangles.count, "pixel"), triangles.max, triangles.edges);
    if (shadows.edges > 0)
        text += fmt::format("; {} in another shadow, all beside a shadow boundary (tolerance: {} of {})",
                            shadows.count, shadows.max, shadows.edges);
    if (tied > 0) text += fmt::format("; {} where two surfaces have the same depth", tied);
    return text;
}

}  // namespace diptych
