// SPDX-License-Identifier: MIT
// Atlas layout of point and spot shadow maps: which faces of which lights have a tile, with size and
// position. No Vulkan; in double and metres.
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

// Side of the smallest tile, texels. At least half of it remains inside the filter's border.
inline constexpr int minTile = 32;

// User settings.
struct AtlasRequest {
    int size = 2048;    // texels along a side, rounded down to a power of two; larger if tiles need it
    int kernel = 3;     // side of the filter, texels
    double bias = 0.5;  // texels, along the geometric normal
};

// Texels on each side of a receiver that may be sampled: the filter's radius, the receiver's offset, and
// snapping to whole texels.
double marginOf(const AtlasRequest& request);

// A shadow-casting light.
struct AtlasLight {
    glm::dvec3 position;               // world
    std::array<glm::dvec3, 3> axes{};  // unit, world
    double near = 0, far = 0;          // m along a face, at depths 1 and 0
    double tangent = 1;                // of half a face's angle
    // Per face: index in LocalAtlas::tiles; -1: no tile.
    std::array<int, gpu::LOCAL_FACES> tiles{-1, -1, -1, -1, -1, -1};
};

struct AtlasTile {
    std::size_t light = 0;
    gpu::uint face = 0;
    glm::ivec2 corner{0};  // texels
    int size = 0;          // texels along a side; a power of two
    double texels = 0;     // per unit of the tangent
};

struct LocalAtlas {
    int side = 0;  // texels; 0: no tiles
    std::vector<AtlasLight> lights{};
    std::vector<AtlasTile> tiles{};
    std::size_t unseen = 0;  // faces without a tile because no visible receiver is in them
    std::size_t empty = 0;   // faces without a tile because no caster is in them

    // Transform from world axes relative to `eye` to clip space of a tile: x and y in -1..1, depth as in
    // shared/contract/local_shadow.h.
    glm::dmat4 clipFromWorld(const AtlasTile& tile, const glm::dvec3& eye) const;
};

// Axes of a face: two across, one along.
std::array<glm::dvec3, 3> faceAxes(const AtlasLight& light, gpu::uint face);

// Corners of bounding boxes, in world axes from the camera.
using WorldBoxes = std::span<const std::array<glm::dvec3, 8>>;

// `lights`: shadow-casting points and spots. `bounds`: of all casters and receivers; `seen`: of visible
// geometry; `casting`: of casters. A face gets a tile if boxes of both intersect it within the light's
// range, and it intersects the view.
// A tile's side is proportional to the part of the image's height that the light may reach: at most half
// the atlas for a spot, a quarter for cube faces. If the tiles do not fit, the largest are halved, those
// of the last lights first. A border of the filter's size surrounds each tile's area.
LocalAtlas layOutAtlas(std::span<const Light> lights, const Bounds& bounds, WorldBoxes seen,
                       WorldBoxes casting, const View& view, const AtlasRequest& request);

// For shaders: each light with its faces, LOCAL_SHADOW_TEXELS texels.
std::vector<glm::vec4> gpuTexels(const LocalAtlas& atlas, const AtlasRequest& request);

}  // namespace diptych
