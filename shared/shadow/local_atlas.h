// SPDX-License-Identifier: MIT
// Where the shadow maps of points and spots lie in their atlas: which faces of which light have a tile, of
// which size, and where. No Vulkan; everything is in double and in metres.
#pragma once

#include "shared/contract/local_shadow.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <array>
#include <span>
#include <vector>

namespace diptych {

// The smallest tile, texels: what is left within the edges that a filter reads is a quarter of it at least.
inline constexpr int leastTile = 32;

// What the user chooses.
struct AtlasRequest {
    int size = 2048;    // texels of a side, rounded down to a power of two; more where tiles need it
    int kernel = 3;     // side of the filter, texels
    double bias = 0.5;  // texels, along the geometric normal
};

// Texels on each side that are read for what a tile serves: what the filter reads, and where a surface is
// moved to before it reads.
double marginOf(const AtlasRequest& request);

// A light that casts.
struct AtlasLight {
    glm::dvec3 position;               // world
    std::array<glm::dvec3, 3> axes{};  // unit, world
    double near = 0, far = 0;          // m along a face: of the depths 1 and 0
    double tangent = 1;                // of half a face's angle
    // By face: its tile's place in LocalAtlas::tiles, -1: it has none.
    std::array<int, gpu::LOCAL_FACES> tiles{-1, -1, -1, -1, -1, -1};
};

struct AtlasTile {
    std::size_t light = 0;
    gpu::uint face = 0;
    glm::ivec2 corner{0};  // texels
    int size = 0;          // texels of a side, a power of two
    double texels = 0;     // per unit of the tangent
};

struct LocalAtlas {
    int side = 0;  // texels; 0: there is no tile
    std::vector<AtlasLight> lights{};
    std::vector<AtlasTile> tiles{};
    std::size_t unseen = 0;  // faces without a tile, as nothing that is seen lies in them,
    std::size_t empty = 0;   // and others, as nothing that casts does

    // Clip space of a tile from world axes with `eye` as the origin: x and y in -1..1, depth as in
    // shared/contract/local_shadow.h.
    glm::dmat4 clipFromWorld(const AtlasTile& tile, const glm::dvec3& eye) const;
};

// The axes of a face: across, across, along.
std::array<glm::dvec3, 3> faceAxes(const AtlasLight& light, gpu::uint face);

// Bounding boxes: their corners, in world axes from the camera.
using WorldBoxes = std::span<const std::array<glm::dvec3, 8>>;

// `lights`: those that cast, points and spots. `bounds`: of everything that casts or receives; `seen`: of
// what the picture draws; `casting`: of what casts. A face gets a tile where it meets such boxes of both
// within the light's range, and the view. A tile's side follows from the part of the picture's height that
// the light may reach, half the atlas at most for a spot, a quarter for the faces of a cube; if they do not
// fit, the largest are halved, the last lights' first. Around what a tile serves lie as many texels as the
// filter reads.
LocalAtlas layOutAtlas(std::span<const Light> lights, const Bounds& bounds, WorldBoxes seen,
                       WorldBoxes casting, const View& view, const AtlasRequest& request);

// For the shaders, each light with its faces: LOCAL_SHADOW_TEXELS texels.
std::vector<glm::vec4> gpuTexels(const LocalAtlas& atlas, const AtlasRequest& request);

}  // namespace diptych
