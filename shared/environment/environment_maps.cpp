// SPDX-License-Identifier: MIT
#include "shared/environment/environment_maps.h"

#include "shared/environment/bright_pixels.h"

#include <tbb/parallel_for.h>
#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace diptych {

namespace {

constexpr int maxSourceSide = 1024, minSourceSide = 16;  // of the environment's own map, texels
constexpr int diffuseSide = 33, diffuseSourceSide = 64, minPyramidSide = 4;

// Proportional to a node's solid angle. Edge nodes count half, because they occur twice.
double nodeWeight(const NodeMap& map, int x, int y) {
    const glm::dvec3 d(octahedralDirection(map.positionOf(x, y)));
    const double l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    const auto edge = [&](int i) { return i == 0 || i + 1 == map.side ? 0.5 : 1.0; };
    return l1 * l1 * l1 * edge(x) * edge(y);
}

// Means of 2x2 pixels. Neighbouring rows differ in solid angle only within a hundredth of a degree of the
// poles.
Environment halved(const Environment& fine) {
    Environment coarse{fine.name, Image(fine.radiance.width / 2, fine.radiance.height / 2, 3)};
    tbb::parallel_for(0, coarse.radiance.height, [&](int y) {
        for (int x = 0; x < coarse.radiance.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto at = [&](int i, int j) { return fine.radiance.at(2 * x + i, 2 * y + j, c); };
                coarse.radiance.at(x, y, c) = 0.25f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1));
            }
    });
    return coarse;
}

// Height of an image with 2:1 aspect ratio and the same pixel density.
int finenessOf(int width, int height) {
    return std::max(height, (width + 1) / 2);
}

bool canBeHalved(int width, int height) {
    return finenessOf(width, height) >= 4 * maxSourceSide && width % 2 == 0 && height % 2 == 0;
}

bool canBeHalved(const Image& image) {
    return canBeHalved(image.width, image.height);
}

// Side of the environment's own map. A map of `height` texels per side has texels of the size of pixels at
// the horizon.
int sourceSide(int width, int height) {
    for (; canBeHalved(width, height); height /= 2) width /= 2;
    return static_cast<int>(std::bit_ceil(
        static_cast<unsigned>(std::clamp(finenessOf(width, height), minSourceSide, maxSourceSide))));
}

}  // namespace

EnvironmentMaps makeEnvironmentMaps(const Environment& environment, const EnvironmentRequest& request) {
    EnvironmentMaps maps;
    maps.harmonics = project(LatLong(environment));
    // Images far finer than every map are downsampled first.
    Environment even = canBeHalved(environment.radiance) ? halved(environment) : environment;
    while (canBeHalved(even.radiance)) even = halved(even);
    const BrightPixels suns(even);
    const LatLong light(even);
    const int side = sourceSide(even.radiance.width, even.radiance.height);
    OctahedralMap whole = resampled(light, side);
    suns.addTo(whole);
    std::vector<BrightTexel> bright;
    if (request.prefilter) bright = takeBrightTexels(whole);
    const std::vector<OctahedralMap> source = pyramid(std::move(whole), minPyramidSide);
    const auto coarse =
        std::ranges::find_if(source, [](const OctahedralMap& map) { return map.side <= diffuseSourceSide; });
    maps.diffuse = irradiance(*coarse, diffuseSide, bright);
    if (!request.prefilter) {
        for (const OctahedralMap& level : source) maps.levels.push_back(atNodes(level, level.side + 1));
        return maps;
    }
    maps.levels.push_back(resampledToNodes(light, side + 1));
    suns.addTo(maps.levels.back());
    for (std::size_t level = 1; level < gpu::ENVIRONMENT_SPECULAR_LEVELS; ++level) {
        maps.levels.push_back(filtered(source, levelAlpha(level), levelSide(level, side), request.quality));
        addBrightTexels(maps.levels.back(), bright, levelAlpha(level));
    }
    return maps;
}

MapSides mapSides(int width, int height, bool prefilter) {
    MapSides sides{diffuseSide, {}};
    const int side = sourceSide(width, height);
    if (prefilter)
        for (std::size_t level = 0; level < gpu::ENVIRONMENT_SPECULAR_LEVELS; ++level)
            sides.levels.push_back(levelSide(level, side));
    else  // powers of two, down to the last level of pyramid()
        for (int each = side; each >= minPyramidSide; each /= 2) sides.levels.push_back(each + 1);
    return sides;
}

// Rows of maps, large to small.
EnvironmentAtlas layOut(const EnvironmentMaps& maps) {
    std::vector<const NodeMap*> all;
    for (const NodeMap& level : maps.levels) all.push_back(&level);
    all.push_back(&maps.diffuse);
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return all[i]->side; });
    EnvironmentAtlas atlas;
    atlas.width = all[order.front()]->side;
    std::vector<glm::ivec2> corners(all.size());
    glm::ivec2 next(0);
    for (const std::size_t i : order) {
        const int side = all[i]->side;
        if (next.x + side > atlas.width) next = {0, atlas.height};
        corners[i] = next;
        next.x += side;
        atlas.height = std::max(atlas.height, next.y + side);
    }
    atlas.texels.resize(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height));
    std::vector<glm::vec4> places;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const int side = all[i]->side;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const Texel& t = all[i]->at(x, y);
                atlas.texels[static_cast<std::size_t>(corners[i].y + y) *
                                 static_cast<std::size_t>(atlas.width) +
                             static_cast<std::size_t>(corners[i].x + x)] = {t[0], t[1], t[2], 0};
            }
        places.emplace_back(corners[i].x, corners[i].y, all[i]->side, 0);
    }
    atlas.diffuse = places.back();
    places.pop_back();
    atlas.levels = std::move(places);
    return atlas;
}

TruncationError truncationError(const EnvironmentMaps& maps, double window) {
    const auto polynomial = irradiancePolynomial(maps.harmonics, window);
    TruncationError error;
    double peak = 0, weights = 0;
    const NodeMap& map = maps.diffuse;
    for (int y = 0; y < map.side; ++y)
        for (int x = 0; x < map.side; ++x) {
            const glm::dvec3 kept =
                glm::max(evaluate(polynomial, octahedralDirection(map.positionOf(x, y))), glm::dvec3(0));
            const Texel& t = map.at(x, y);
            const double weight = nodeWeight(map, x, y);
            weights += weight;
            for (int c = 0; c < 3; ++c) {
                const double off = std::abs(kept[c] - double{t[c]});
                error.worst = std::max(error.worst, off);
                error.mean += off * weight / 3;
                peak = std::max(peak, double{t[c]});
            }
        }
    if (!(peak > 0)) return {};
    return {error.mean / weights / peak, error.worst / peak};
}

}  // namespace diptych
