// SPDX-License-Identifier: MIT
// Radiance of all directions on a square (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors"), with +Y in its middle and -Y at its four corners.
#pragma once

#include "shared/environment/lat_long.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace diptych {

// Places p are in [-1, 1]^2. The solid angle of an area element there is |d|_1^3 of its direction d.
glm::vec2 octahedralPlace(const glm::vec3& direction);
glm::vec3 octahedralDirection(glm::vec2 place);  // unit

// A texel of four floats, which compilers keep in one register.
using Texel = float __attribute__((vector_size(16)));

// side x side texels with a border of one: the texels that are next to them on the sphere, so that bilinear
// interpolation has no seam.
struct OctahedralMap {
    int side = 0;
    std::vector<Texel> texels{};  // (side + 2)^2; the fourth component is 0

    OctahedralMap() = default;
    explicit OctahedralMap(int s)
        : side(s), texels(static_cast<std::size_t>(s + 2) * static_cast<std::size_t>(s + 2)) {}
    Texel& at(int x, int y) { return texels[offset(x, y)]; }
    const Texel& at(int x, int y) const { return texels[offset(x, y)]; }
    glm::vec2 placeOf(int x, int y) const {
        const float step = 2.0f / static_cast<float>(side);
        return {(static_cast<float>(x) + 0.5f) * step - 1, (static_cast<float>(y) + 0.5f) * step - 1};
    }
    double solidAngle(int x, int y) const;  // of a texel, sr
    Texel bilinear(glm::vec2 place) const {
        const float half = 0.5f * static_cast<float>(side);
        const float x = place.x * half + half + 0.5f, y = place.y * half + half + 0.5f;
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

// The same on nodes: side x side of them, side odd, from edge to edge. The sphere's folds, where the square
// is not smooth (x, y or z is 0), run along nodes and along diagonals of the cells between them, so that
// linear interpolation over the triangles on their two sides errs by the square of a cell, not by a cell; and
// opposite ends of an edge are one node, so that there is no seam.
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
    glm::vec2 placeOf(int x, int y) const {
        const float step = 2 / static_cast<float>(side - 1);
        return {static_cast<float>(x) * step - 1, static_cast<float>(y) * step - 1};
    }
    glm::vec3 interpolated(glm::vec2 place) const;
};

// The radiance at nodes, each the mean over the directions that are nearer to it than to others.
NodeMap resampledToNodes(const LatLong& light, int side);
// A map at nodes.
NodeMap atNodes(const OctahedralMap& map, int side);

// The radiance in a map of `side` texels, each the mean over its own directions.
OctahedralMap resampled(const LatLong& light, int side);

// The map and its means of four texels, weighted by solid angle, down to a side of `least`.
std::vector<OctahedralMap> pyramid(OctahedralMap map, int least);

}  // namespace diptych
