// SPDX-License-Identifier: MIT
// Environments given as the six faces of a cube.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace diptych {

// Faces of `side` x `side` x 3 radiances in the order +X, -X, +Y, -Y, +Z, -Z, as seen from inside, row 0
// on top. Up is +Y on the four side faces, -Z on the top face and +Z on the bottom face; on these two, -X
// is to the right.
struct CubeMap {
    int side = 0;
    std::array<Image, 6> faces{};
};

// Bilinear, also across face edges. The direction need not be normalized but must not be 0.
glm::dvec3 radianceOf(const CubeMap& cube, const glm::dvec3& direction);

// A lat-long image laid out as Environment, four faces wide and two high. Each pixel is the mean of 2 x 2
// samples. `cube_from_world` rotates.
Image latLongOf(const CubeMap& cube, const glm::dmat3& cube_from_world);

// Decodes RGBD of EXT_lights_image_based: linear colour divided by alpha; 0 if alpha is 0.
Image decodedRgbd(const TextureImage& image);

}  // namespace diptych
