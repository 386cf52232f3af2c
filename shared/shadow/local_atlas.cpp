// SPDX-License-Identifier: MIT
#include "shared/shadow/local_atlas.h"

#include "shared/scene/lights/shadow_casters.h"
#include "shared/scene/model/axes.h"
#include "shared/shadow/scene_bounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace diptych {

namespace {

// Near distance relative to the light's range; closer geometry casts no shadow.
constexpr double nearestCaster = 1e-5;
// Margin for rounding, relative to distances.
constexpr double atlasSlack = 1e-3;

AtlasLight atlasLight(const Light& light, const Bounds& bounds) {
    AtlasLight result{.position = light.position, .axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
    if (light.kind == LightKind::spot) {
        const glm::dvec3 x = perpendicularTo(light.direction);
        result.axes = {x, glm::cross(light.direction, x), light.direction};
        if (shadowTiles(light) == 1) result.tangent = std::tan(double{light.outer_cone});
    }
    // A cone of zero width still covers a pixel.
    result.tangent = std::max(result.tangent, 1e-3) * (1 + atlasSlack);
    double farthest = 0;
    for (const glm::dvec3& corner : cornersOf(bounds))
        farthest = std::max(farthest, glm::distance(corner, light.position));
    result.far = std::min(double{light.range}, farthest) * (1 + atlasSlack);
    result.near = result.far * nearestCaster;
    return result;
}

// Whether all points are outside a plane, by their signed distances.
template <class Points, class Distance>
bool allBeyond(const Points& points, const Distance& distance) {
    return std::ranges::all_of(points, [&](const auto& point) { return distance(point) < 0; });
}

// Whether a box may overlap the lit part of a face; corners relative to the light. `wider`: factor on the
// face's width.
bool meets(const AtlasLight& light, gpu::uint face, std::array<glm::dvec3, 8> corners, double wider) {
    const std::array<glm::dvec3, 3> axes = faceAxes(light, face);
    double size = 0;
    for (glm::dvec3& corner : corners) {
        corner = {glm::dot(corner, axes[0]), glm::dot(corner, axes[1]), glm::dot(corner, axes[2])};
        size = std::max(size, glm::length(corner));
    }
    const double slack = atlasSlack * size;
    for (int axis = 0; axis < 2; ++axis)
        for (const double sign : {-1.0, 1.0})
            if (allBeyond(corners, [&](const glm::dvec3& c) {
                    return wider * light.tangent * c.z + sign * c[axis] + slack;
                }))
                return false;
    return !allBeyond(corners, [&](const glm::dvec3& c) { return c.z + slack; }) &&
           !allBeyond(corners, [&](const glm::dvec3& c) { return light.far - c.z + slack; });
}

// Whether the lit part of a face may be in view.
bool isInView(const AtlasLight& light, gpu::uint face, const View& view) {
    const std::array<glm::dvec3, 3> axes = faceAxes(light, face);
    const glm::dmat4 clipFromWorld = view.clipFromWorld();
    std::array<glm::dvec4, 5> points;
    double size = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        glm::dvec3 point = light.position - view.eye();
        if (i > 0)
            point +=
                light.far *
                (axes[2] + light.tangent * ((i & 1 ? 1.0 : -1.0) * axes[0] + (i & 2 ? 1.0 : -1.0) * axes[1]));
        points[i] = clipFromWorld * glm::dvec4(point, 1);
        for (int c = 0; c < 4; ++c) size = std::max(size, std::abs(points[i][c]));
    }
    const double slack = atlasSlack * size;
    for (int axis = 0; axis < 2; ++axis)
        for (const double sign : {-1.0, 1.0})
            if (allBeyond(points, [&](const glm::dvec4& p) { return p.w + sign * p[axis] + slack; }))
                return false;
    return !allBeyond(points, [&](const glm::dvec4& p) { return p.w - p.z + slack; });
}

// Fraction of the image's height that the light may reach, at most 1.
double influenceOf(const AtlasLight& light, const View& view) {
    if (view.camera.orthographic) return std::min(light.far / view.camera.ymag, 1.0);
    const double distance = glm::distance(light.position, view.eye());
    if (distance <= light.far) return 1;
    return std::min(light.far / (distance * std::tan(view.camera.yfov / 2)), 1.0);
}

// Every other bit of a number, starting at bit `first`.
int everyOtherBit(std::uint64_t number, int first) {
    int result = 0;
    for (int bit = 0; bit < 31; ++bit) result |= static_cast<int>(number >> (2 * bit + first) & 1) << bit;
    return result;
}

// Places tiles along a Z-order curve: squares of decreasing powers of two leave no gap.
void place(LocalAtlas& atlas) {
    std::vector<std::size_t> order(atlas.tiles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return atlas.tiles[i].size; });
    std::uint64_t next = 0;
    for (const std::size_t i : order) {
        AtlasTile& tile = atlas.tiles[i];
        tile.corner = {everyOtherBit(next, 0), everyOtherBit(next, 1)};
        next += static_cast<std::uint64_t>(tile.size) * static_cast<std::uint64_t>(tile.size);
    }
    // Shrinks the atlas to the used area.
    const auto area = [](int side) {
        return static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
    };
    while (next <= area(atlas.side / 2)) atlas.side /= 2;
}

}  // namespace

std::array<glm::dvec3, 3> faceAxes(const AtlasLight& light, gpu::uint face) {
    const gpu::uint along = face / 2;
    return {light.axes[(along + 1) % 3], light.axes[(along + 2) % 3],
            light.axes[along] * (face % 2 == 0 ? 1.0 : -1.0)};
}

double marginOf(const AtlasRequest& request) {
    const double radius = (request.kernel + 1) / 2.0;
    return radius + std::numbers::sqrt2 * radius + request.bias + 1;
}

glm::dmat4 LocalAtlas::clipFromWorld(const AtlasTile& tile, const glm::dvec3& eye) const {
    const AtlasLight& light = lights[tile.light];
    const std::array<glm::dvec3, 3> axes = faceAxes(light, tile.face);
    const glm::dvec3 origin = eye - light.position;
    const double scale = tile.texels / (tile.size / 2.0);
    const double offset = -light.near / (light.far - light.near), numerator = -offset * light.far;
    glm::dmat4 clip(0);
    for (int i = 0; i < 3; ++i)
        clip[i] = glm::dvec4(scale * axes[0][i], scale * axes[1][i], offset * axes[2][i], axes[2][i]);
    const double depth = glm::dot(axes[2], origin);
    clip[3] = glm::dvec4(scale * glm::dot(axes[0], origin), scale * glm::dot(axes[1], origin),
                         offset * depth + numerator, depth);
    return clip;
}

LocalAtlas layOutAtlas(std::span<const Light> lights, const Bounds& bounds, WorldBoxes seen,
                       WorldBoxes casting, const View& view, const AtlasRequest& request) {
    LocalAtlas atlas;
    for (const Light& light : lights) {
        AtlasLight& made = atlas.lights.emplace_back(atlasLight(light, bounds));
        const int faces = shadowTiles(light);
        for (gpu::uint face = 0; face < gpu::LOCAL_FACES; ++face) {
            if (faces == 1 ? face != 4 : faces == 5 && face == 5) continue;
            const auto any = [&](WorldBoxes boxes, double wider) {
                return std::ranges::any_of(boxes, [&](auto corners) {
                    for (glm::dvec3& corner : corners) corner += view.eye() - made.position;
                    return meets(made, face, corners, wider);
                });
            };
            // A filter samples beyond the face, up to twice its width.
            const bool shown = isInView(made, face, view) && any(seen, 1);
            if (!shown || !any(casting, 2)) {
                ++(shown ? atlas.empty : atlas.unseen);
                continue;
            }
            made.tiles[face] = static_cast<int>(atlas.tiles.size());
            atlas.tiles.push_back({.light = atlas.lights.size() - 1, .face = face});
        }
    }
    if (atlas.tiles.empty()) return atlas;
    const int min = minTile * static_cast<int>(std::ceil(std::sqrt(static_cast<double>(atlas.tiles.size()))));
    atlas.side = static_cast<int>(std::max(std::bit_floor(static_cast<unsigned>(request.size)),
                                           std::bit_ceil(static_cast<unsigned>(min))));
    std::int64_t texels = 0;
    for (AtlasTile& tile : atlas.tiles) {
        const Light& light = lights[tile.light];
        const int largest = std::max(atlas.side / (shadowTiles(light) == 1 ? 2 : 4), minTile);
        const double wanted = largest * influenceOf(atlas.lights[tile.light], view);
        tile.size = std::max(static_cast<int>(std::bit_floor(static_cast<unsigned>(wanted))), minTile);
        texels += std::int64_t{tile.size} * tile.size;
    }
    while (texels > std::int64_t{atlas.side} * atlas.side) {
        const auto largest =
            std::ranges::max_element(atlas.tiles.rbegin(), atlas.tiles.rend(), {}, &AtlasTile::size);
        const std::size_t light = largest->light;
        for (AtlasTile& tile : atlas.tiles)
            if (tile.light == light) {
                texels -= std::int64_t{3} * (tile.size / 2) * (tile.size / 2);
                tile.size /= 2;
            }
    }
    place(atlas);
    const double margin = marginOf(request);
    for (AtlasTile& tile : atlas.tiles)
        tile.texels =
            (tile.size / 2.0 - std::min(margin, tile.size / 4.0)) / atlas.lights[tile.light].tangent;
    return atlas;
}

std::vector<glm::vec4> gpuTexels(const LocalAtlas& atlas, const AtlasRequest& request) {
    std::vector<glm::vec4> texels;
    for (const AtlasLight& light : atlas.lights) {
        const double offset = -light.near / (light.far - light.near);
        texels.emplace_back(light.axes[0], -offset * light.far);
        texels.emplace_back(light.axes[1], offset);
        texels.emplace_back(light.axes[2], request.bias);
        for (const int number : light.tiles) {
            gpu::LocalFace face{{0, 0}, 0, 0};
            if (number >= 0) {
                const AtlasTile& tile = atlas.tiles[static_cast<std::size_t>(number)];
                face.centre = glm::vec2(tile.corner) + static_cast<float>(tile.size) / 2;
                face.texels = static_cast<float>(tile.texels);
                face.max_filter_offset = static_cast<float>((tile.size - request.kernel - 1) / 2.0);
            }
            texels.emplace_back(face.centre, face.texels, face.max_filter_offset);
        }
    }
    return texels;
}

}  // namespace diptych
