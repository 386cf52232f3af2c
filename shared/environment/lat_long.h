// SPDX-License-Identifier: MIT
// A lat-long picture as the radiance of all directions, as shared/scene/model/scene.h defines it.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace diptych {

class LatLong {
public:
    // `environment` must outlive this; its sides are at least 1.
    explicit LatLong(const Environment& environment) : image_(environment.radiance) {}

    int width() const { return image_.width; }
    int height() const { return image_.height; }
    const Image& image() const { return image_; }
    // W/(sr m^2), bilinear between the pixels' centres; direction unit.
    glm::vec3 radiance(const glm::vec3& direction) const;
    // Of the centre of a pixel, unit; x and y may lie between pixels.
    glm::dvec3 direction(double x, double y) const;
    // The solid angle that a pixel of each row is weighted with, sr: the integral over all directions of its
    // share in the bilinear interpolation. All pixels' add up to 4 pi.
    std::vector<double> solidAngles() const;

private:
    const Image& image_;
};

}  // namespace diptych
