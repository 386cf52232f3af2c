// SPDX-License-Identifier: MIT
// Filters an environment for the specular lobe, with viewer, normal and reflected direction equal (Karis
// 2013, "Real Shading in Unreal Engine 4"), by filtered importance sampling (Krivanek and Colbert 2008,
// "Real-time Shading with Filtered Importance Sampling").
#pragma once

#include "shared/environment/octahedral_map.h"

#include <vector>

namespace diptych {

struct FilterQuality {
    int samples = 256;  // directions per texel of a level
    float bias = 0;     // mip levels added to each direction's level
    bool operator==(const FilterQuality&) const = default;
};

// Mean of radiance weighted by GGX of width `alpha` and n.l, for every node of a map of `side`. A sample
// reads `source`, a pyramid(), at the level whose texels have the sample's solid angle. The solid angle is
// that of the source's texels in this direction, so it does not depend on the result's resolution. Levels
// are clamped to the pyramid.
NodeMap filtered(const std::vector<OctahedralMap>& source, double alpha, int side,
                 const FilterQuality& quality);

// Light of single bright texels above a bound, as light from one direction. Sampling it would cause
// fireflies or miss it.
struct BrightTexel {
    glm::vec3 direction;
    Texel power;  // radiance times solid angle, W/m^2
};
// Removes from the map the part of its brightest texels, at most maxBrightTexels, above 8 times its mean.
std::vector<BrightTexel> takeBrightTexels(OctahedralMap& map);
inline constexpr std::size_t maxBrightTexels = 256;
// Adds these texels under the same lobe.
void addBrightTexels(NodeMap& filtered, const std::vector<BrightTexel>& texels, double alpha);

// Reference for filtered(): sums over every texel of one level of the source.
NodeMap filteredExhaustively(const OctahedralMap& source, double alpha, int side);

// Irradiance / pi, summed over every texel and over the texels removed from it.
NodeMap irradiance(const OctahedralMap& source, int side, const std::vector<BrightTexel>& bright = {});

// Levels of the specular lobe (contract/environment.h): GGX alpha, and nodes per side, odd, for a source
// of `max` texels per side.
double levelAlpha(std::size_t level);
int levelSide(std::size_t level, int max);

}  // namespace diptych
