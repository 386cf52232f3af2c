// SPDX-License-Identifier: MIT
#include "shared/environment/octahedral_map.h"

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych {

namespace {

float signOf(float x) {
    return x >= 0 ? 1.0f : -1.0f;
}

glm::vec2 wrapped(glm::vec2 p) {
    return {(1 - std::abs(p.y)) * signOf(p.x), (1 - std::abs(p.x)) * signOf(p.y)};
}

}  // namespace

glm::vec2 octahedralPosition(const glm::vec3& d) {
    const float scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    const glm::vec2 p(d.x * scale, d.z * scale);
    return d.y < 0 ? wrapped(p) : p;
}

glm::vec3 octahedralDirection(glm::vec2 p) {
    const float y = 1 - std::abs(p.x) - std::abs(p.y);
    if (y < 0) p = wrapped(p);
    return glm::normalize(glm::vec3(p.x, y, p.y));
}

// Midpoints of 4x4 parts: within 1e-3 of the integral of |d|_1^3 for 16 texels per side.
double OctahedralMap::solidAngle(int x, int y) const {
    const double step = 2.0 / side;
    double sum = 0;
    constexpr int parts = 4;
    for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i) {
            const double px = std::abs(step * (x + (i + 0.5) / parts) - 1),
                         py = std::abs(step * (y + (j + 0.5) / parts) - 1), pz = 1 - px - py;
            // The fold is symmetric: below the horizon, (1 - y, 1 - x) has the same distance.
            const double a = pz < 0 ? 1 - py : px, b = pz < 0 ? 1 - px : py;
            const double square = a * a + b * b + pz * pz;
            sum += 1 / (square * std::sqrt(square));
        }
    return sum * step * step / (parts * parts);
}

// Texel -1 of a row is texel 0 of the mirrored row.
void OctahedralMap::fillBorder() {
    for (int i = 0; i < side; ++i) {
        at(-1, i) = at(0, side - 1 - i);
        at(side, i) = at(side - 1, side - 1 - i);
        at(i, -1) = at(side - 1 - i, 0);
        at(i, side) = at(side - 1 - i, side - 1);
    }
    at(-1, -1) = at(side - 1, side - 1);
    at(side, side) = at(0, 0);
    at(-1, side) = at(side - 1, 0);
    at(side, -1) = at(0, side - 1);
}

glm::dvec3 OctahedralMap::integral() const {
    glm::dvec3 sum(0);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double weight = solidAngle(x, y);
            const Texel& t = at(x, y);
            sum += glm::dvec3(t[0], t[1], t[2]) * weight;
        }
    return sum;
}

namespace {

// Mean over a square of the map, weighted by solid angle. `middle` and `width` are in units of [-1, 1]^2;
// beyond its edges the square continues on the sphere.
Texel meanOver(const LatLong& light, glm::vec2 middle, float width, int parts) {
    glm::vec3 sum(0);
    float weights = 0;
    for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i) {
            const auto along = [&](int k) {
                return width * ((static_cast<float>(k) + 0.5f) / static_cast<float>(parts) - 0.5f);
            };
            glm::vec2 position = middle + glm::vec2(along(i), along(j));
            if (std::abs(position.x) > 1) position = {2 * signOf(position.x) - position.x, -position.y};
            if (std::abs(position.y) > 1) position = {-position.x, 2 * signOf(position.y) - position.y};
            const glm::vec3 d = octahedralDirection(position);
            const float l1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z), weight = l1 * l1 * l1;
            sum += light.radiance(d) * weight;
            weights += weight;
        }
    const glm::vec3 mean = sum / weights;
    return Texel{mean.x, mean.y, mean.z, 0};
}

// About two samples per source pixel and axis, where the pixels are narrowest in the map.
int partsOf(const LatLong& light, int side) {
    const double rows = std::max(light.height(), light.width() / 2);
    return std::clamp(static_cast<int>(std::lround(std::ceil(3 * rows / side))), 2, 16);
}

}  // namespace

OctahedralMap resampled(const LatLong& light, int side) {
    OctahedralMap map(side);
    tbb::parallel_for(0, side, [&](int y) {
        for (int x = 0; x < side; ++x)
            map.at(x, y) =
                meanOver(light, map.positionOf(x, y), 2 / static_cast<float>(side), partsOf(light, side));
    });
    map.fillBorder();
    return map;
}

NodeMap resampledToNodes(const LatLong& light, int side) {
    NodeMap map(side);
    tbb::parallel_for(0, side, [&](int y) {
        for (int x = 0; x < side; ++x)
            map.at(x, y) =
                meanOver(light, map.positionOf(x, y), 2 / static_cast<float>(side - 1), partsOf(light, side));
    });
    return map;
}

NodeMap atNodes(const OctahedralMap& map, int side) {
    NodeMap nodes(side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) nodes.at(x, y) = map.bilinear(nodes.positionOf(x, y));
    return nodes;
}

// Same interpolation as mapRadiance() of shaders/lib/environment/environment.glsl.
glm::vec3 NodeMap::interpolated(glm::vec2 position) const {
    const float cells = static_cast<float>(side - 1);
    const glm::vec2 at = (position * 0.5f + 0.5f) * cells;
    const glm::ivec2 c = glm::min(glm::ivec2(at), glm::ivec2(side - 2));
    const glm::vec2 f = at - glm::vec2(c);
    const auto node = [&](int x, int y) {
        const Texel& t = this->at(c.x + x, c.y + y);
        return glm::vec3(t[0], t[1], t[2]);
    };
    if (position.x * position.y >= 0) {
        const float beyond = f.x + f.y - 1;
        return beyond < 0 ? node(0, 0) * -beyond + node(1, 0) * f.x + node(0, 1) * f.y
                          : node(1, 1) * beyond + node(1, 0) * (1 - f.y) + node(0, 1) * (1 - f.x);
    }
    const float right = f.x - f.y;
    return right > 0 ? node(0, 0) * (1 - f.x) + node(1, 0) * right + node(1, 1) * f.y
                     : node(0, 0) * (1 - f.y) + node(0, 1) * -right + node(1, 1) * f.x;
}

std::vector<OctahedralMap> pyramid(OctahedralMap map, int min) {
    std::vector<OctahedralMap> levels;
    levels.push_back(std::move(map));
    while (levels.back().side % 2 == 0 && levels.back().side / 2 >= min) {
        const OctahedralMap& fine = levels.back();
        OctahedralMap coarse(fine.side / 2);
        tbb::parallel_for(0, coarse.side, [&](int y) {
            for (int x = 0; x < coarse.side; ++x) {
                Texel sum{};
                float weights = 0;
                for (int i = 0; i < 4; ++i) {
                    const int fx = 2 * x + i % 2, fy = 2 * y + i / 2;
                    const auto weight = static_cast<float>(fine.solidAngle(fx, fy));
                    sum += fine.at(fx, fy) * weight;
                    weights += weight;
                }
                coarse.at(x, y) = sum / weights;
            }
        });
        coarse.fillBorder();
        levels.push_back(std::move(coarse));
    }
    return levels;
}

}  // namespace diptych
