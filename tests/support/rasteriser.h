// SPDX-License-Identifier: MIT
// For tests of triangle culling: meshes, views, and a rasteriser that finds triangles covering a sample.
#pragma once

#include "shared/contract/samples.h"
#include "shared/draw/visible_meshlets.h"
#include "shared/scene/view.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace diptych::tests {

struct TriangleMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

// Radius 1 m, counter-clockwise seen from outside. `rough`: scale of random vertex offsets, m.
inline TriangleMesh ballOf(int rings, double rough, std::mt19937& random,
                           const glm::vec3& middle = glm::vec3(0)) {
    std::uniform_real_distribution<double> part(-1, 1);
    TriangleMesh ball;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i <= 2 * rings; ++i) {
            const double phi = 3.14159265 * j / rings, theta = 3.14159265 * i / rings;
            const glm::dvec3 at(std::sin(phi) * std::cos(theta), std::cos(phi),
                                -std::sin(phi) * std::sin(theta));
            ball.positions.push_back(middle +
                                     glm::vec3(at * (1 + rough * part(random)) +
                                               rough * glm::dvec3(part(random), part(random), part(random))));
        }
    const auto at = [&](int j, int i) { return static_cast<std::uint32_t>(j * (2 * rings + 1) + i); };
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < 2 * rings; ++i) {
            const std::uint32_t a = at(j, i), b = at(j + 1, i), c = at(j + 1, i + 1), d = at(j, i + 1);
            ball.indices.insert(ball.indices.end(), {a, b, c, a, c, d});
        }
    return ball;
}

// 2 m square around the origin, facing +Z: its bounding box is tight.
inline TriangleMesh boardOf(int squares) {
    TriangleMesh board;
    const auto at = [&](int j, int i) { return static_cast<std::uint32_t>(j * (squares + 1) + i); };
    for (int j = 0; j <= squares; ++j)
        for (int i = 0; i <= squares; ++i) {
            board.positions.emplace_back(2.0f * static_cast<float>(i) / static_cast<float>(squares) - 1.0f,
                                         2.0f * static_cast<float>(j) / static_cast<float>(squares) - 1.0f,
                                         0.0f);
            if (i < squares && j < squares)
                board.indices.insert(board.indices.end(), {at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j, i),
                                                           at(j + 1, i + 1), at(j + 1, i)});
        }
    return board;
}

// View from `eye`; `fov`: vertical, radians.
inline View viewOf(const SampleGrid& grid, const glm::dvec3& eye, const glm::dvec3& target, double fov,
                   double near, bool orthographic) {
    View view;
    view.width = grid.width;
    view.height = grid.height;
    view.camera.world_from_camera = glm::inverse(glm::lookAt(eye, target, glm::dvec3(0, 1, 0)));
    view.camera.yfov = fov;
    view.camera.near = near;
    view.camera.far = 1000;
    view.camera.orthographic = orthographic;
    view.camera.ymag = 0.5 * glm::distance(eye, target);
    return view;
}

// A device as Vulkan specifies it: float32 products, vertices snapped to a grid, coverage by the signs of
// exact areas and the top-left rule.
class Rasteriser {
public:
    // `truncates`: snaps vertices down, not to the nearest grid point. `reversed`: sums the products of a
    // row in reverse order, as some devices do.
    Rasteriser(const SampleGrid& grid, bool truncates, bool reversed = false)
        : grid_(grid), truncates_(truncates), reversed_(reversed) {}

    // Whether the triangle covers a sample of the image and faces the camera (`either`: faces any way).
    // False if a vertex has w <= 0.
    bool shows(const glm::mat4& clipFromObject, std::array<glm::vec3, 3> corners, bool mirrored,
               bool either) const {
        std::array<glm::i64vec2, 3> at;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec4 clip = product(clipFromObject, corners[i]);
            if (!(clip.w > 0)) return false;
            at[i] = {snapped((clip.x / clip.w + 1) * 0.5f * static_cast<float>(grid_.width)),
                     snapped((clip.y / clip.w + 1) * 0.5f * static_cast<float>(grid_.height))};
        }
        const auto area = [](const glm::i64vec2& a, const glm::i64vec2& b, const glm::i64vec2& c) {
            return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        };
        std::int64_t whole = area(at[0], at[1], at[2]);
        // y points down: counter-clockwise areas are negative.
        const bool front = mirrored ? whole > 0 : whole < 0;
        if (whole == 0 || (!front && !either)) return false;
        if (whole < 0) std::swap(at[1], at[2]);
        const glm::i64vec2 low = glm::min(at[0], glm::min(at[1], at[2])),
                           high = glm::max(at[0], glm::max(at[1], at[2]));
        const auto pixel = [&](std::int64_t x, int max) {
            return std::clamp<std::int64_t>(x / step - (x % step < 0), 0, max);
        };
        for (std::int64_t y = pixel(low.y, grid_.height); y <= pixel(high.y, grid_.height - 1); ++y)
            for (std::int64_t x = pixel(low.x, grid_.width); x <= pixel(high.x, grid_.width - 1); ++x)
                for (int s = 0; s < grid_.samples; ++s) {
                    const glm::i64vec2 p = glm::i64vec2(x, y) * step + sample(s);
                    bool inside = true;
                    for (std::size_t e = 0; e < 3 && inside; ++e) {
                        const glm::i64vec2 a = at[e], b = at[(e + 1) % 3];
                        const std::int64_t side = area(a, b, p);
                        const bool upperLeft = (a.y == b.y && b.x > a.x) || b.y < a.y;
                        inside = side > 0 || (side == 0 && upperLeft);
                    }
                    if (inside) return true;
                }
        return false;
    }

private:
    glm::vec4 product(const glm::mat4& m, const glm::vec3& p) const {
        return reversed_ ? ((m[3] + m[2] * p.z) + m[1] * p.y) + m[0] * p.x
                         : ((m[0] * p.x + m[1] * p.y) + m[2] * p.z) + m[3];
    }
    static constexpr std::int64_t step = 4096;  // units per pixel; fine enough for the snap and sample grids
    std::int64_t snapped(float x) const {
        const double steps = double{x} / grid_.snap;
        return static_cast<std::int64_t>(truncates_ ? std::floor(steps) : std::nearbyint(steps)) *
               static_cast<std::int64_t>(grid_.snap * step);
    }
    glm::i64vec2 sample(int s) const {
        if (grid_.samples == 1) return {step / 2, step / 2};
        const gpu::uint low = grid_.samples == 4 ? gpu::SAMPLE_LOCATIONS_4 : gpu::SAMPLE_LOCATIONS_8_LOW;
        const gpu::uint location = ((s < 4 ? low : gpu::SAMPLE_LOCATIONS_8_HIGH) >> (8 * (s % 4))) & 255u;
        return {(location & 15u) * step / 16, (location >> 4) * step / 16};
    }
    SampleGrid grid_;
    bool truncates_, reversed_;
};

}  // namespace diptych::tests
