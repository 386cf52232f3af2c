// SPDX-License-Identifier: MIT
// Procedural textures for the built-in scenes. They tile seamlessly. They are computed in integers (normal
// maps also use an exactly rounded square root), so they are bitwise identical on every machine.
#pragma once

#include "shared/scene/model/scene.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace diptych {

using Rgba8 = std::array<std::uint8_t, 4>;

// size x size heights, row 0 on top, each 0 to 65535.
struct HeightField {
    int size = 0;
    std::vector<int> height;
    int at(int x, int y) const;  // coordinates wrap around
};

HeightField brickHeights(int size);    // 4 x 8 bricks in running bond, each slightly different
HeightField tileHeights(int size);     // 4 x 4 tiles with rounded edges
HeightField plasterHeights(int size);  // smooth noise, five octaves
HeightField weaveHeights(int size);    // 8 x 8 over-and-under strands

// A tangent-space normal map; `relief` is the height in texels of the value 65535.
TextureImage normalMap(const std::string& name, const HeightField& heights, double relief);

// Bricks or tiles. Odd rows of bricks are shifted by half a brick.
struct Masonry {
    int cells, rows;
    bool bricks;
};
// Interpolates from `low` at height 0 to `high` at height 65535. Then darkens each brick or tile by up to
// `variation` / 255.
TextureImage colorMap(const std::string& name, const HeightField& heights, Rgba8 low, Rgba8 high,
                      const Masonry& masonry, int variation);

TextureImage checker(const std::string& name, int size, int cells, Rgba8 a, Rgba8 b);
// One green leaf, stem at the bottom; alpha is 0 around it.
TextureImage leaf(const std::string& name, int size);
TextureImage lattice(const std::string& name, int size);  // 4 x 4 diamonds of brass, alpha 0 in the openings
TextureImage brushed(const std::string& name, int size);  // roughness (G) in streaks along u; metallic (B) 1
// R, darker at low heights.
TextureImage occlusion(const std::string& name, const HeightField& heights);
TextureImage dusk(const std::string& name, int size);    // amber at the horizon to night blue, with stars
TextureImage glyphs(const std::string& name, int size);  // 8 x 8 glowing signs of 5 x 5 squares, on black

}  // namespace diptych
