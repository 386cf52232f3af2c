// SPDX-License-Identifier: MIT
// An environment filtered for the specular lobe (Karis 2013, "Real Shading in Unreal Engine 4": the viewer,
// the normal and the mirrored direction are one), by filtered importance sampling (Krivanek and Colbert 2008,
// "Real-time Shading with Filtered Importance Sampling").
#pragma once

#include "shared/environment/octahedral_map.h"

#include <vector>

namespace diptych {

struct FilterQuality {
    int samples = 256;  // directions a texel of a level
    float bias = 0;     // mip levels by which what a direction stands for is widened
    bool operator==(const FilterQuality&) const = default;
};

// The mean of the radiance under GGX of width `alpha` times n.l, for every node of a map of `side`. A sample
// reads `source`, a pyramid(), at the level whose texels are as large as its share of the solid angle: that
// of the source's own texels there, whatever the result's resolution. The level is clamped to the pyramid's.
NodeMap filtered(const std::vector<OctahedralMap>& source, double alpha, int side,
                 const FilterQuality& quality);

// What single texels have above a bound, as light from one direction each: filtered by samples it would
// sparkle or vanish.
struct BrightTexel {
    glm::vec3 direction;
    Texel power;  // radiance times solid angle, W/m^2
};
// Takes from the map what its brightest texels, mostBrightTexels at most, have above 8 times its mean.
std::vector<BrightTexel> takeBrightTexels(OctahedralMap& map);
inline constexpr std::size_t mostBrightTexels = 256;
// Adds what they are under the same lobe.
void addBrightTexels(NodeMap& filtered, const std::vector<BrightTexel>& texels, double alpha);

// The same by the sum over every texel of one level of the source: what it is held against.
NodeMap filteredExhaustively(const OctahedralMap& source, double alpha, int side);

// Irradiance over pi, summed over every texel, and over those that were taken from it.
NodeMap irradiance(const OctahedralMap& source, int side, const std::vector<BrightTexel>& bright = {});

// Levels of the specular lobe (contract/environment.h): the GGX width of one, and how many nodes a side
// hold what is filtered by it, where the source has `most` texels: odd.
double levelAlpha(std::size_t level);
int levelSide(std::size_t level, int most);

}  // namespace diptych
