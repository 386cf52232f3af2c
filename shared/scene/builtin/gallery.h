// SPDX-License-Identifier: MIT
// The layout of the gallery, m. x points to the right. The hall runs from the camera at z = 5.5 to the end
// wall at z = -10; the brick wall is on the left, the arcade on the right.
#pragma once

#include "shared/scene/builtin/builder.h"

#include <string>

namespace diptych::builtin {

using glm::dvec2;
using glm::dvec3;
using glm::vec3;

inline constexpr double LEFT = -4.5, RIGHT = 4.2, NEAR_END = 6, FAR_END = -10, CEILING = 4.6;
inline constexpr vec3 WARM{1.0f, 0.62f, 0.32f}, COOL{0.42f, 0.66f, 1.0f}, CYAN{0.25f, 0.85f, 1.0f},
    ROSE{1.0f, 0.28f, 0.42f}, IVORY{1.0f, 0.86f, 0.7f};

// Floor area of an object: centre and half extents in x and z.
struct Footprint {
    double x, z, half_x, half_z;
};
inline constexpr Footprint STAGE{0.2, -2.9, 2.6, 1.15}, KNOT{0.2, -8.2, 0.55, 0.55},
    GEM{2.4, 1.45, 0.34, 0.34}, VASE{2.62, -0.75, 0.38, 0.38}, PLANTER{-2.75, 0.9, 0.42, 0.42};

struct Room {
    Builder& b;
    int stone = 0, brass = 0, dark_wood = 0;

    int glowing(const std::string& name, const vec3& radiance);
};

void addWalls(Room& room);     // gallery_room.cpp: floor, walls, arcade, ceiling, the sky outside
void addExhibits(Room& room);  // gallery_exhibits.cpp: exhibits, plants, screens

}  // namespace diptych::builtin
