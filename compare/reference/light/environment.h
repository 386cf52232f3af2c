// SPDX-License-Identifier: MIT
// Light from a lat-long environment, sampled over all directions.
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
    // `rotation`: about +Y, counter-clockwise seen from above, rad.
    EnvironmentLight(const Environment& environment, double factor, double rotation = 0);

    bool black() const { return !(brightness_ > 0) || factor_ == 0; }
    glm::dvec3 radiance(const glm::dvec3& direction) const;  // W/(sr m^2); direction unit
    // Size of the environment map, and the direction of a position in it, in pixels.
    int width() const { return image_.width; }
    int height() const { return image_.height; }
    glm::dvec3 directionOf(double x, double y) const;

    // Samples directions with a density proportional to brightness times a weight per block of the map;
    // the weight estimates how much the surface reflects. (After Clarberg et al. 2005, "Wavelet Importance
    // Sampling", which multiplies down to the pixel.)
    class Sampler {
    public:
        // The weight of directions within distance `reach` (of unit vectors) of `middle`, at least 0. It
        // must be above 0 wherever some of that light is reflected.
        using Weight = std::function<double(const glm::dvec3& middle, double reach)>;
        Sampler(const EnvironmentLight& light, const Weight& weight);

        // u in [0, 1)^2; all() must be above 0.
        glm::dvec3 operator()(const glm::dvec2& u) const;
        double density(const glm::dvec3& direction) const;  // 1/sr
        double all() const { return cumulative_.back(); }

    private:
        const EnvironmentLight& light_;
        std::vector<double> cumulative_;  // over the blocks
    };

private:
    // A rectangle of pixels with cumulative weights: of its rows, and of the pixels in each row.
    struct Block {
        int x, y, width, height;
        glm::dvec3 middle;  // a direction
        double reach;       // largest distance of a direction in the block from `middle`
        std::vector<double> rows, columns;
    };
    struct Pixel {
        int x, y;
    };
    double column(const glm::dvec3& direction) const;  // in pixels, from 0 to the width
    glm::dvec3 texel(int x, int y) const;
    Pixel pixelOf(const glm::dvec3& direction) const;
    std::size_t blockOf(Pixel pixel) const;

    const Image& image_;
    double factor_, rotation_, brightness_ = 0;
    std::vector<Block> blocks_;
    int across_ = 1, down_ = 1;   // blocks
    std::vector<double> weight_;  // of each pixel: brightness times solid angle
    std::vector<double> solid_;   // solid angle of a pixel, by row, sr
};

}  // namespace diptych::reference
