// SPDX-License-Identifier: MIT
// How an environment was meant, told from what white faces take of its light.
#pragma once

#include "shared/image/image.h"

#include <glm/vec3.hpp>

#include <span>

namespace diptych::external {

struct TiltedFace {
    glm::dvec3 normal{0, 0, 1};  // world, unit
    glm::dvec3 shown{0};         // radiance of a white Lambertian face, W/(sr m^2)
};

struct SkyMeaning {
    bool mirrored = false;  // left for right, before it is turned
    double turned = 0;  // degrees about +Y, counter-clockwise seen from above; a multiple of 5, -175 to 180
    bool cut_off = false;  // its radiance ends at 1
    double factor = 1;     // on its radiance
    double residual = 0;   // of what the faces show, root mean square, a share
};

// `sky`: a lat-long picture (shared/scene/model/scene.h). Every turn by 5 degrees, mirrored or not, cut off
// or not is tried, each with the factor that suits it; a deviation is believed where it leaves less than half
// of what no deviation leaves.
SkyMeaning skyMeaning(const Image& sky, std::span<const TiltedFace> faces);

// What a white face of that normal shows, W/(sr m^2).
glm::dvec3 lightFrom(const Image& sky, const glm::dvec3& normal, bool cut_off);

}  // namespace diptych::external
