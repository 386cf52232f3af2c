// SPDX-License-Identifier: MIT
// The light of a lat-long environment, every direction of it.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace diptych::reference {

class EnvironmentLight {
public:
    EnvironmentLight(const Environment& environment, double factor);

    bool black() const { return !(brightness_ > 0) || factor_ == 0; }
    glm::dvec3 radiance(const glm::dvec3& direction) const;  // W/(sr m^2); direction unit

    // Draws directions by brightness times what a surface makes of it: by a weight for each block of the
    // picture. (After Clarberg et al. 2005, "Wavelet Importance Sampling", which multiplies to the last
    // pixel.)
    class Sampler {
    public:
        // Of light from no further than `reach` (of unit vectors) about a direction, 0 or more; above 0
        // wherever some of that light counts.
        using Weight = std::function<double(const glm::dvec3& middle, double reach)>;
        Sampler(const EnvironmentLight& light, const Weight& weight);

        // u in [0, 1)^2. No light where all() is 0.
        glm::dvec3 operator()(const glm::dvec2& u) const;
        double density(const glm::dvec3& direction) const;  // 1/sr
        double all() const { return cumulative_.back(); }

    private:
        const EnvironmentLight& light_;
        std::vector<double> cumulative_;  // by block
    };

private:
    // A rectangle of pixels with their cumulative weights: of its rows, and of each row's pixels.
    struct Block {
        int x, y, width, height;
        glm::dvec3 middle;  // a direction
        double reach;       // to the furthest of it
        std::vector<double> rows, columns;
    };
    struct Pixel {
        int x, y;
    };
    glm::dvec3 texel(int x, int y) const;
    glm::dvec3 directionOf(double x, double y) const;  // in pixels
    Pixel pixelOf(const glm::dvec3& direction) const;
    std::size_t blockOf(Pixel pixel) const;

    const Image& image_;
    double factor_, brightness_ = 0;
    std::vector<Block> blocks_;
    int across_ = 1, down_ = 1;   // blocks
    std::vector<double> weight_;  // of each pixel: brightness times solid angle
    std::vector<double> solid_;   // solid angle of a pixel, by row, sr
};

}  // namespace diptych::reference
