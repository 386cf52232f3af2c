// SPDX-License-Identifier: MIT
// Octahedral maps: radiance of all directions on a square (Cigolle et al. 2014, "A Survey of Efficient
// Representations for Independent Unit Vectors"). +Y is at the centre and -Y at the four corners.
#pragma once

#include "shared/environment/lat_long.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace diptych {

// Points p are in [-1, 1]^2. The solid angle per area there is |d|_1^3, for a unit direction d.
glm::vec2 octahedralPosition(const glm::vec3& direction);
glm::vec3 octahedralDirection(glm::vec2 position);  // unit

// A texel of four floats, which fits one vector register.
using Texel = float __attribute__((vector_size(16)));

// side x side texels with a border of one. Border texels repeat their neighbours on the sphere, so that
// bilinear interpolation has no seam.
struct OctahedralMap {
    int side = 0;
    std::vector<Texel> texels{};  // (side + 2)^2; the fourth component is 0

    OctahedralMap() = default;
    explicit OctahedralMap(int s)
        : side(s), texels(static_cast<std::size_t>(s + 2) * static_cast<std::size_t>(s + 2)) {}
    Texel& at(int x, int y) { return texels[offset(x, y)]; }
    const Texel& at(int x, int y) const { return texels[offset(x, y)]; }
    glm::vec2 positionOf(int x, int y) const {
        const float step = 2.0f / static_cast<float>(side);
        return {(static_cast<float>(x) + 0.5f) * step - 1, (static_cast<float>(y) + 0.5f) * step - 1};
    }
    double solidAngle(int x, int y) const;  // of a texel, sr
    Texel bilinear(glm::vec2 position) const {
        const float half = 0.5f * static_cast<float>(side);
        const float x = position.x * half + half + 0.5f, y = position.y * half + half + 0.5f;
        const int left = static_cast<int>(x), top = static_cast<int>(y);
        const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
        const Texel* t = texels.data() + static_cast<std::size_t>(top) * static_cast<std::size_t>(side + 2) +
                         static_cast<std::size_t>(left);
        const Texel* u = t + side + 2;
        const Texel above = t[0] + (t[1] - t[0]) * fx, below = u[0] + (u[1] - u[0]) * fx;
        return above + (below - above) * fy;
    }
    void fillBorder();
    glm::dvec3 integral() const;  // over all directions

private:
    std::size_t offset(int x, int y) const {
        return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(side + 2) +
               static_cast<std::size_t>(x + 1);
    }
};

// A map with values at side x side nodes, side odd, from edge to edge. The map has folds where x, y or z
// is 0. They run along nodes and along diagonals of the cells. Linear interpolation over the two triangles
// of a cell then has an error quadratic in the cell size, also at folds. Opposite ends of an edge are the
// same node, so there is no seam.
struct NodeMap {
    int side = 0;
    std::vector<Texel> nodes{};

    NodeMap() = default;
    explicit NodeMap(int s) : side(s), nodes(static_cast<std::size_t>(s) * static_cast<std::size_t>(s)) {}
    Texel& at(int x, int y) {
        return nodes[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                     static_cast<std::size_t>(x)];
    }
    const Texel& at(int x, int y) const {
        return nodes[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                     static_cast<std::size_t>(x)];
    }
    glm::vec2 positionOf(int x, int y) const {
        const float step = 2 / static_cast<float>(side - 1);
        return {static_cast<float>(x) * step - 1, static_cast<float>(y) * step - 1};
    }
    glm::vec3 interpolated(glm::vec2 position) const;
};

// Radiance at nodes, each the mean over the directions nearest to it.
NodeMap resampledToNodes(const LatLong& light, int side);
// Bilinear samples of a map at nodes.
NodeMap atNodes(const OctahedralMap& map, int side);

// Radiance in a map of side x side texels, each the mean over its directions.
OctahedralMap resampled(const LatLong& light, int side);

// Mip pyramid of the map: means of 2x2 texels weighted by solid angle, down to a side of `min`.
std::vector<OctahedralMap> pyramid(OctahedralMap map, int min);

}  // namespace diptych
