// SPDX-License-Identifier: MIT
// A lat-long image as a function of direction, as shared/scene/model/scene.h defines it.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace diptych {

class LatLong {
public:
    // `environment` must outlive this; its width and height are at least 1.
    explicit LatLong(const Environment& environment) : image_(environment.radiance) {}

    int width() const { return image_.width; }
    int height() const { return image_.height; }
    const Image& image() const { return image_; }
    // W/(sr m^2), bilinear between pixel centres; direction unit.
    glm::vec3 radiance(const glm::vec3& direction) const;
    // Direction of a pixel's centre, unit; x and y may be fractional.
    glm::dvec3 direction(double x, double y) const;
    // Solid angle of a pixel in each row, sr: the integral over all directions of its weight in bilinear
    // interpolation. The sum over all pixels is 4 pi.
    std::vector<double> solidAngles() const;

private:
    const Image& image_;
};

}  // namespace diptych
