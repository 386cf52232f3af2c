// SPDX-License-Identifier: MIT
#pragma once

#include "compare/reference/scene/material.h"
#include "shared/scene/view.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace diptych::reference {

// The camera rays of an image. Pixels are square; (0, 0) is the upper left corner of the first. Directions
// advance one metre in depth.
class PixelRays {
public:
    explicit PixelRays(const View& view)
        : backward_(view.backward()), orthographic_(view.camera.orthographic) {
        const double half = orthographic_ ? view.camera.ymag : std::tan(view.camera.yfov / 2);
        x_ = view.right() * (2 * half / view.height);
        y_ = view.up() * (-2 * half / view.height);
        corner_ = x_ * (-0.5 * view.width) + y_ * (-0.5 * view.height);
    }

    // The ray through a point of the image, with the differences to rays `apart` pixels further.
    PixelRay through(double x, double y, double apart = 1) const {
        const glm::dvec3 point = corner_ + x_ * x + y_ * y, none(0);
        if (orthographic_) return {point, -backward_, x_ * apart, none, y_ * apart, none};
        return {none, point - backward_, none, x_ * apart, none, y_ * apart};
    }

    double depth(const glm::dvec3& position) const { return -glm::dot(position, backward_); }
    glm::dvec3 toViewer(const glm::dvec3& position) const {
        return orthographic_ ? backward_ : -glm::normalize(position);
    }

private:
    glm::dvec3 backward_, x_{0}, y_{0}, corner_{0};
    bool orthographic_;
};

}  // namespace diptych::reference
