// SPDX-License-Identifier: MIT
// Which lights cast shadows: the paths shadow these, and so does the reference that they are held against.
#pragma once

#include "shared/scene/model/scene.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

// Of the directional lights the one with the most luminance, the first of several; nothing where none shines.
std::optional<std::size_t> brightestSun(std::span<const Light> lights);
// By which lights of one kind are compared: the luminance of color x intensity.
double strengthOf(const Light& light);

// How many tiles of the atlas of local shadows a point or a spot takes (shared/contract/local_shadow.h): one
// for a spot whose cone fits a face; else one for each face that it may reach.
int shadowTiles(const Light& light);

// The points and spots that cast, in ascending order: those that ask for it (Light::shadow) and the
// `brightest` most intense others (luminance times intensity; of equals the first), as long as the atlas has
// room for their tiles, the more intense first, whatever the view. Lights that give nothing never do.
struct LocalCasting {
    std::vector<std::size_t> lights;
    std::size_t without_room = 0;  // lights that would cast too
    std::size_t unshadowed = 0;    // points and spots that shine and do not cast, those among them
};
LocalCasting localCasting(std::span<const Light> lights, int brightest);

// The lights that cast, in ascending order of their places in `lights`: the sun and the local ones.
std::vector<std::size_t> castingLights(std::span<const Light> lights, int brightest_locals);

}  // namespace diptych
