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

// A texture coordinate, and its change from a pixel to the next.
struct Footprint {
    glm::dvec2 uv{0}, dx{0}, dy{0};
};

// Averages of 2^k x 2^k texels, linear, in float32; level 0 is the image itself. Sizes are rounded up, and
// every texel of a level covers the same share of the picture.
class Pyramid {
public:
    Pyramid(const TextureImage& image, bool srgb);

    // RGBA of a texel, linear (0 to 1, except for images of floats); x and y must be inside the level.
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

// The scene's textures, decoded at their first use; may be used from any thread.
class Textures {
public:
    explicit Textures(const Scene& scene) : scene_(scene) {}

    // The mean over the parallelogram of the footprint. A footprint smaller than a texel uses the sampler's
    // magnification filter. Otherwise it is a box filter: the mean of 8 x 8 points, up to 64 along the
    // longer side, each read bilinearly from the level whose texels have the size of a point's share. sRGB
    // is decoded before filtering. Returns RGBA, 0 to 1.
    glm::dvec4 operator()(const Texture& texture, bool srgb, const Footprint& footprint) const;

private:
    const Pyramid& pyramid(int image, bool srgb) const;

    const Scene& scene_;
    mutable std::mutex mutex_;
    mutable std::map<std::pair<int, bool>, std::unique_ptr<Pyramid>> pyramids_;
};

}  // namespace diptych::reference
