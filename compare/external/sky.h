// SPDX-License-Identifier: MIT
// Infers a renderer's interpretation of an environment from its light on white faces.
#pragma once

#include "shared/image/image.h"

#include <glm/vec3.hpp>

#include <span>

namespace diptych::external {

struct TiltedFace {
    glm::dvec3 normal{0, 0, 1};  // world, unit
    glm::dvec3 radiance{0};      // radiance of a white Lambertian face, W/(sr m^2)
};

struct SkyInterpretation {
    bool mirrored = false;  // left to right, before rotation
    double rotation = 0;    // degrees about +Y, counterclockwise from above; multiple of 5, -175 to 180
    bool cut_off = false;   // radiance is clipped at 1
    double factor = 1;      // on radiance
    double residual = 0;    // RMS over the faces, relative
};

// `sky`: a lat-long image (shared/scene/model/scene.h). Tries rotations by 5 degrees, mirrored or not,
// clipped or not, each with its best factor. Reports a deviation only if it more than halves the residual.
SkyInterpretation skyInterpretation(const Image& sky, std::span<const TiltedFace> faces);

// Radiance of a white face with this normal, W/(sr m^2).
glm::dvec3 lightFrom(const Image& sky, const glm::dvec3& normal, bool cut_off);

}  // namespace diptych::external
