// SPDX-License-Identifier: MIT
// Environments that are given as the six faces of a cube.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace diptych {

// Faces of `side` x `side` x 3 radiances in the order +X, -X, +Y, -Y, +Z, -Z, each as it is seen from within
// with row 0 on top: +Y is up on the four at the sides, -Z on that above and +Z on that below, and -X is to
// the right on these two.
struct CubeMap {
    int side = 0;
    std::array<Image, 6> faces{};
};

// Linear between the texels' centres, across the edges of faces as well; direction of any length but 0.
glm::dvec3 radianceOf(const CubeMap& cube, const glm::dvec3& direction);

// A picture of all directions as of Environment, four times as wide and twice as high as a face, each pixel
// the mean of 2 x 2 places. `cube_from_world` rotates.
Image latLongOf(const CubeMap& cube, const glm::dmat3& cube_from_world);

// A face from its picture, EXT_lights_image_based's RGBD: the linear colour over the alpha. Where alpha is 0
// there is no such quotient, and it is 0.
Image decodedRgbd(const TextureImage& picture);

}  // namespace diptych
