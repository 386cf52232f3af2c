// SPDX-License-Identifier: MIT
// The light of a lat-long environment, every direction of it.
#pragma once

#include "shared/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace diptych::reference {

class EnvironmentLight {
public:
    EnvironmentLight(const Environment& environment, double factor);

    bool black() const { return !(rows_.back() > 0) || factor_ == 0; }
    glm::dvec3 radiance(const glm::dvec3& direction) const;  // W/(sr m^2); direction unit

    // A direction drawn by brightness, u in [0, 1)^2, and the density of that, 1/sr.
    glm::dvec3 sample(const glm::dvec2& u) const;
    double density(const glm::dvec3& direction) const;

private:
    double texel(int x, int y, int c) const;

    const Image& image_;
    double factor_;
    // Cumulative: of the rows, and of each row's pixels; the last entry of each is 1, or 0 where it is black.
    std::vector<double> rows_, columns_;
    std::vector<double> weight_;  // of each pixel, all together 1
};

}  // namespace diptych::reference
