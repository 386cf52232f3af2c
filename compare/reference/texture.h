// SPDX-License-Identifier: MIT
// What a texture looks like over a pixel's footprint.
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

// Where in a texture, and how it moves from a pixel to the next: texture coordinates per pixel.
struct Footprint {
    glm::dvec2 uv{0}, dx{0}, dy{0};
};

// Averages of 2^k x 2^k texels, linear, in float32; level 0 is the image itself. An image of odd size keeps
// its last texels: each texel of a level covers the same share of the picture.
class Pyramid {
public:
    Pyramid(const TextureImage& image, bool srgb);

    // RGBA of a texel, linear (0 to 1 but of floats), with coordinates inside the level.
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
    std::vector<Level> levels_;  // from 1
};

// The scene's textures, decoded as they are first asked for; from any thread.
class Textures {
public:
    explicit Textures(const Scene& scene) : scene_(scene) {}

    // The mean over the parallelogram of the footprint: where it is smaller than a texel, what the sampler's
    // magnification says; else the box filter, an area mean of 8 x 8 places and up to 64 along its longer
    // side, each looked up bilinearly in the level whose texels are as large as a place's share. sRGB colours
    // are decoded first. RGBA, 0 to 1.
    glm::dvec4 operator()(const Texture& texture, bool srgb, const Footprint& footprint) const;

private:
    const Pyramid& pyramid(int image, bool srgb) const;

    const Scene& scene_;
    mutable std::mutex mutex_;
    mutable std::map<std::pair<int, bool>, std::unique_ptr<Pyramid>> pyramids_;
};

}  // namespace diptych::reference
