// SPDX-License-Identifier: MIT
// Textures filtered over a pixel's footprint.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace diptych::reference {

// A texture coordinate, and its change to the next pixels.
struct Footprint {
    glm::dvec2 uv{0}, dx{0}, dy{0};
};

// Means of 2^k x 2^k texels, linear, float32; level 0 is the image itself. Sizes are rounded up, and every
// texel of a level covers an equal part of the image.
class Pyramid {
public:
    Pyramid(const TextureImage& image, bool srgb);

    // RGBA of a texel, linear (0 to 1, except for float images); x and y must be inside the level.
    glm::dvec4 texel(int level, int x, int y) const;
    int width(int level) const;
    int height(int level) const;
    int levels() const { return static_cast<int>(levels_.size()) + 1; }

private:
    const TextureImage& image_;
    bool srgb_;
    struct Level {
        int width, height;
        std::vector<float> rgba;
    };
    std::vector<Level> levels_;  // from level 1 on
};

// The scene's textures, decoded at first use. Thread-safe.
class Textures {
public:
    explicit Textures(const Scene& scene) : scene_(scene) {}

    // The mean over the parallelogram of the footprint, RGBA, 0 to 1. A footprint smaller than a texel
    // uses the sampler's magnification filter. Otherwise it is a box filter: the mean of 8 x 8 points, or
    // up to 64 along the longer side. Each point is read bilinearly from the level whose texels match the
    // point spacing. sRGB is decoded before filtering.
    glm::dvec4 operator()(const Texture& texture, bool srgb, const Footprint& footprint) const;

private:
    const Pyramid& pyramid(int image, bool srgb) const;

    const Scene& scene_;
    mutable std::mutex mutex_;
    mutable std::map<std::pair<int, bool>, std::unique_ptr<Pyramid>> pyramids_;
};

}  // namespace diptych::reference
