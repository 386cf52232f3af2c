// SPDX-License-Identifier: MIT
// Selects the lights that cast shadows, for both paths and for the reference.
#pragma once

#include "shared/scene/model/scene.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

// The directional light with the highest luminance, the first among equals; none if no directional light
// shines.
std::optional<std::size_t> brightestSun(std::span<const Light> lights);
// Luminance of color x intensity, which ranks lights of one type.
double strengthOf(const Light& light);

// Tiles that a point or spot light takes in the atlas of local shadows (shared/contract/local_shadow.h):
// one for a spot light whose cone fits a cube face, else one per face that it may reach.
int shadowTiles(const Light& light);

// The point and spot lights that cast shadows, in ascending order of index. Candidates are those with
// Light::shadow and the `brightest` most intense others (luminance times intensity; the first among
// equals). The atlas takes the more intense first while tiles remain, whatever the view. Lights of zero
// intensity or range never cast.
struct LocalCasting {
    std::vector<std::size_t> lights;
    std::size_t over_capacity = 0;  // candidates for which the atlas has no tiles left
    // Shining point and spot lights without a shadow, including over_capacity.
    std::size_t unshadowed = 0;
};
LocalCasting localCasting(std::span<const Light> lights, int brightest);

// Indices into `lights` of all lights that cast shadows, ascending: the brightest sun and the local ones.
std::vector<std::size_t> castingLights(std::span<const Light> lights, int brightest_locals);

}  // namespace diptych
