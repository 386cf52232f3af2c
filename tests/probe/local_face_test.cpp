// SPDX-License-Identifier: MIT
// Lookups in the atlas tiles of a local light: across edges and corners of its cube, and with filters that
// stay above the surface's own plane.
#include "shared/contract/features.h"
#include "shared/shadow/local_atlas.h"
#include "shared/shadow/scene_bounds.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace diptych {
namespace {

// Light at the centre of a box of 4 m; all six cube faces have tiles.
struct Cube {
    AtlasRequest request;
    View view;
    LocalAtlas atlas;
    std::vector<glm::vec4> texels;

    explicit Cube(int size = 1024, int kernel = 3, double bias = 0) {
        request = {size, kernel, bias};
        view.width = view.height = 90;
        view.camera.world_from_camera =
            glm::inverse(glm::lookAt(glm::dvec3(0, 0, 3), glm::dvec3(0), glm::dvec3(0, 1, 0)));
        Bounds bounds;
        bounds.min = glm::dvec3(-2);
        bounds.max = glm::dvec3(2);
        std::array<glm::dvec3, 8> box = cornersOf(bounds);
        for (glm::dvec3& corner : box) corner -= view.eye();
        atlas =
            layOutAtlas(std::array{Light{}}, bounds, std::span(&box, 1), std::span(&box, 1), view, request);
        texels = gpuTexels(atlas, request);
    }
};

struct Received {
    glm::vec2 texel{0};
    double depth = 0, min = 0;
    int face = 0;
};

// `places`: positions, relative to the light, and normals.
std::vector<Received> received(const Cube& cube, const std::vector<std::pair<glm::vec3, glm::vec3>>& places) {
    std::vector<float> in;
    for (const auto& [position, normal] : places) {
        for (const glm::vec3& v : {position, normal, glm::vec3(cube.texels[0]), glm::vec3(cube.texels[1]),
                                   glm::vec3(cube.texels[2])})
            in.insert(in.end(), {v.x, v.y, v.z});
        in.insert(in.end(), {cube.texels[0].w, cube.texels[1].w, cube.texels[2].w});
        for (std::size_t face = 0; face < 6; ++face) {
            const glm::vec4& f = cube.texels[3 + face];
            in.insert(in.end(), {f.x, f.y, f.z, f.w});
        }
    }
    const std::vector<float> out =
        Probes().run("local_face", in, 42, 5,
                     {{gpu::FEATURE_shadow_kernel, static_cast<std::uint32_t>(cube.request.kernel)}});
    std::vector<Received> result;
    for (std::size_t i = 0; i < out.size(); i += 5)
        result.push_back(
            {{out[i + 1], out[i + 2]}, double{out[i + 3]}, double{out[i + 4]}, static_cast<int>(out[i])});
    return result;
}

// World direction of a texel in the rendered atlas, through the tile that owns it.
glm::dvec3 drawnIn(const Cube& cube, const glm::vec2& texel) {
    for (const AtlasTile& tile : cube.atlas.tiles) {
        const glm::dvec2 within = glm::dvec2(texel) - glm::dvec2(tile.corner);
        if (std::min(within.x, within.y) < 0 || std::max(within.x, within.y) > tile.size) continue;
        const glm::dvec2 at = within / (tile.size / 2.0) - 1.0;
        const glm::dmat4 world = glm::inverse(cube.atlas.clipFromWorld(tile, cube.view.eye()));
        const glm::dvec4 far = world * glm::dvec4(at, 0, 1);
        return glm::normalize(glm::dvec3(far) / far.w + cube.view.eye());
    }
    return glm::dvec3(0);
}

// Largest angle between a position's direction and that of the texel it reads, in texels at a face's
// centre.
double farthestOff(const Cube& cube, const std::vector<std::pair<glm::vec3, glm::vec3>>& places,
                   const std::vector<Received>& read) {
    double max = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::dvec3 direction = glm::normalize(glm::dvec3(places[i].first));
        max = std::max(max, glm::length(drawnIn(cube, read[i].texel) - direction));
    }
    return max * double{cube.texels[3].z};
}

// Pairs of directions a quarter of a texel apart: `inside` a face, or on both sides of an edge or corner
// of the cube.
std::vector<std::pair<glm::vec3, glm::vec3>> pairsOf(const Cube& cube, int count, bool inside) {
    std::mt19937 random(inside ? 3 : 4);
    std::uniform_real_distribution<float> any(-1, 1);
    const float step = 0.125f / cube.texels[3].z;
    std::vector<std::pair<glm::vec3, glm::vec3>> places;
    for (int i = 0; i < count; ++i) {
        const int face = i % 6, axis = face / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
        glm::vec3 position(0), apart(0);
        position[axis] = face % 2 == 0 ? 1.0f : -1.0f;
        position[a] = inside ? 0.9f * any(random) : any(random) < 0 ? -1.0f : 1.0f;
        position[b] = inside || i % 4 != 0 ? 0.9f * any(random) : any(random) < 0 ? -1.0f : 1.0f;
        apart[a] = step;
        if (i % 4 == 0) apart[b] = step * any(random);
        const float size = 0.5f + std::abs(any(random));
        for (const float side : {-1.0f, 1.0f}) {
            const glm::vec3 at = size * (position + side * apart);
            places.emplace_back(at, -glm::normalize(at));
        }
    }
    return places;
}

// A lookup reads the texel rendered in its direction, and neighbours across an edge are as close as within
// a face: 10^5 pairs each.
TEST(LocalFace, AcrossEdgesIsAsWithinFaces) {
    const Cube cube;
    constexpr int pairs = 100'000;
    const auto apart = [&](const std::vector<Received>& read) {
        double max = 0;
        for (std::size_t i = 0; i < read.size(); i += 2)
            max = std::max(max, glm::length(drawnIn(cube, read[i].texel) - drawnIn(cube, read[i + 1].texel)));
        return max;
    };
    const auto within = pairsOf(cube, pairs, true), across = pairsOf(cube, pairs, false);
    const std::vector<Received> inside = received(cube, within), outside = received(cube, across);
    int crossed = 0;
    for (std::size_t i = 0; i < outside.size(); i += 2) crossed += outside[i].face != outside[i + 1].face;
    EXPECT_GT(crossed, pairs * 9 / 10);
    EXPECT_LT(farthestOff(cube, within, inside), 0.01);
    EXPECT_LT(farthestOff(cube, across, outside), 0.01);
    EXPECT_LE(apart(outside), apart(inside) * 1.01);
    // Injected faults: two faces swapped, a tile shifted by one texel.
    Cube swapped;
    std::swap(swapped.texels[3], swapped.texels[4]);
    EXPECT_GT(farthestOff(cube, across, received(swapped, across)), 10);
    EXPECT_GT(apart(received(swapped, across)), 10 * apart(inside));
    Cube moved;
    moved.texels[3].x += 1;
    EXPECT_GT(farthestOff(cube, within, received(moved, within)), 0.9);
}

// Depth is along the longest component, across edges too.
TEST(LocalFace, DepthIsAlongTheFace) {
    const Cube cube;
    const auto places = pairsOf(cube, 3000, false);
    const std::vector<Received> read = received(cube, places);
    const AtlasLight& light = cube.atlas.lights[0];
    const double offset = -light.near / (light.far - light.near);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::vec3 size = glm::abs(places[i].first);
        const double along{std::max({size.x, size.y, size.z})};
        EXPECT_NEAR(read[i].depth, -offset * light.far / along + offset, 1e-11);
    }
}

// Planes at any angle to the light, including grazing ones, near a face's edge, in small tiles with wide
// filters. No filter texel is compared with less than the plane's depth there.
TEST(LocalFace, ComparesNothingBelowTheSurfacesPlane) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(-1, 1);
    for (const int size : {64, 2048})
        for (const int kernel : {1, 3, 5, 7}) {
            const Cube cube(size, kernel, 0.5);
            std::vector<std::pair<glm::vec3, glm::vec3>> places;
            for (int i = 0; i < 20'000; ++i) {
                const glm::vec3 at = glm::normalize(glm::vec3(any(random), any(random), any(random))) * 1.5f;
                const glm::vec3 way = glm::normalize(at);
                // Sine of the light's elevation above the plane.
                const float sine = std::pow(10.0f, -2.5f * std::abs(any(random)));
                const glm::vec3 other =
                    glm::normalize(glm::cross(way, glm::vec3(any(random), any(random), any(random))));
                places.emplace_back(at, other * std::sqrt(1 - sine * sine) - way * sine);
            }
            double min = 1;
            for (const Received& r : received(cube, places)) min = std::min(min, r.min / r.depth);
            EXPECT_GT(min, 0) << size << " " << kernel;
        }
}

}  // namespace
}  // namespace diptych
