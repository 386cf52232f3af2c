// SPDX-License-Identifier: MIT
// Test scenes about lights.
#include "shared/scene/builtin/scenes.h"

#include <fmt/format.h>

#include <cmath>

namespace diptych::builtin {
namespace {

// A floor, a wall and six balls that receive the light.
void stage(Builder& b) {
    b.camera("front", {0, 2.2, 7}, {0, 0.8, 0}, 40, 0.1, 100);
    const int grey = b.material("floor and wall", {glm::vec3(0.6f), 0, 0.6f});
    b.add("floor", quad({-5, 0, 4}, {10, 0, 0}, {0, 0, -6}), grey);
    b.add("wall", quad({-5, 0, -2}, {10, 0, 0}, {0, 3.5, 0}), grey);
    for (int i = 0; i < 6; ++i) {
        const int material =
            b.material(fmt::format("ball {}", i),
                       {{0.7f, 0.5f, 0.3f}, static_cast<float>(i % 2), 0.1f + 0.15f * static_cast<float>(i)});
        b.add("ball", sphere(0.45), material, glm::dvec3(1.2 * (i - 2.5), 0.45, 0.3 * (i % 2)));
    }
}

}  // namespace

// Bright lights with short ranges: light remaining at the end of a range would show as a rim.
void rangeEdge(Builder& b) {
    stage(b);
    for (int i = 0; i < 4; ++i)
        b.point({1.8 * (i - 1.5), 0.6 + 0.2 * i, 1.6}, {1.0f, 0.7f, 0.4f}, 5,
                0.9f + 0.1f * static_cast<float>(i));
    b.point({-3, 1, 2.5}, {1.0f, 0.3f, 0.3f}, 5, 1.0f);        // touches the floor
    b.point({3, 1, 2.5}, {0.3f, 1.0f, 0.3f}, 5, 0.999f);       // ends a millimetre above it
    b.point({0, 2.2, 7}, {0.5f, 0.6f, 1.0f}, 10, 5);           // contains the camera
    b.point({-0.6, 0.45, 2.45}, {1.0f, 1.0f, 0.5f}, 6, 2.0f);  // ends on the foremost point of a ball
    b.spot({0, 3, -0.5}, {0, 0, -0.5}, {0.6f, 0.8f, 1.0f}, 20, 3.0f, {15, 25});  // ends on the floor
    b.spot({4, 1.5, 0}, {4, 1.5, -2}, {1.0f, 0.4f, 0.8f}, 10, 2.0f, {0, 40});    // ends on the wall
}

void suns(Builder& b) {
    stage(b);
    b.sun({-0.5, -1, -0.5}, {1.0f, 0.9f, 0.8f}, 2);
    b.sun({0.9, -0.3, -0.3}, {0.3f, 0.5f, 1.0f}, 1);
    b.sun({0, -1, 0}, glm::vec3(1), 0.2f);
    b.sun({0, 1, 0}, {1.0f, 0.2f, 0.1f}, 5);  // from below: lights only the undersides of the balls
}

void points(Builder& b) {
    stage(b);
    for (int i = 0; i < 12; ++i)
        b.point({0.85 * (i - 5.5), 0.4 + 0.8 * (i % 3), 1.4 - 0.7 * (i % 4)},
                {i % 2 == 0 ? 1.0f : 0.4f, 0.7f, i % 2 == 0 ? 0.4f : 1.0f}, 2.0f,
                i % 3 == 0 ? std::numeric_limits<float>::infinity() : 3.0f);
    b.point({0, 0.45, 0.3}, glm::vec3(1), 1, 2);    // inside a ball
    b.point({-4, 0, 2}, {1.0f, 0.5f, 0.5f}, 1, 2);  // in the floor plane
}

// Cones from very narrow to a half-space; one has a hard edge, and one has no range.
void spots(Builder& b) {
    stage(b);
    const double cones[][2] = {{0, 5}, {0, 30}, {14.9, 15}, {20, 40}, {25, 25.0001}, {60, 90}};
    for (int i = 0; i < 6; ++i) {
        const double x = 1.5 * (i - 2.5);
        b.spot({x, 2.6, 0.8}, {0.9 * x, 0, 0},
               {1.0f, 0.6f + 0.06f * static_cast<float>(i), 0.4f + 0.1f * static_cast<float>(i)}, 9,
               i == 3 ? std::numeric_limits<float>::infinity() : 6.0f, {cones[i][0], cones[i][1]});
    }
    // At a grazing angle along the floor.
    b.spot({-4, 0.5, 3}, {3, 0.8, -2}, {0.4f, 0.6f, 1.0f}, 40, 12, {4, 9});
}

// Area lights of all shapes: one-sided and two-sided, above and through the floor, with and without
// ranges, near and far; one encloses a ball.
void areas(Builder& b) {
    stage(b);
    b.rect({-3, 2.4, -1.8}, {-2, 0.5, 1}, {1.0f, 0.7f, 0.4f}, 8).height = 0.5f;
    Light& panel =
        // The lower part is below the floor.
        b.rect({0.6, 0.3, 1.4}, {0.6, 0.5, 0}, {0.5f, 1.0f, 0.6f}, 2, 2.5f);
    panel.width = 0.4f, panel.two_sided = true;
    Light& disc = b.rect({0, 3, 0.5}, {0, 0, 0.5}, {0.8f, 0.9f, 1.0f}, 9, 6);
    disc.kind = LightKind::disc;
    Light& dish = b.rect({3.5, 0.2, -1}, {0, 0.3, 0}, {1.0f, 0.4f, 0.5f}, 10, 4);  // cut by the floor
    dish.kind = LightKind::disc, dish.radius = 0.4f;
    Light& tube = b.rect({2, 0.25, 1.5}, {2, 0, 1.5}, {0.4f, 0.6f, 1.0f}, 25);
    tube.kind = LightKind::tube, tube.radius = 0.05f, tube.axis = glm::normalize(glm::dvec3(1, 0.1, 0.3));
    // The lower part is below the floor.
    Light& column = b.rect({-4, 0.4, 1}, {-3, 0.4, 1}, {1.0f, 0.9f, 0.6f}, 4, 3);
    column.kind = LightKind::tube, column.radius = 0.3f, column.length = 1.5f, column.axis = {0.2, 0.96, 0.2};
    column.axis = glm::normalize(column.axis);
    Light& barrel =
        // Encloses a ball, which stays dark.
        b.rect({-1.8, 0.45, 0}, {-1.8, 0, 0}, {1.0f, 0.5f, 1.0f}, 1, 2);
    barrel.kind = LightKind::tube, barrel.radius = 0.5f, barrel.length = 1.2f;
}

// Has a camera, so that there is no default view. The program may add its default sun; the paths alone
// must render black.
void unlit(Builder& b) {
    stage(b);
}

}  // namespace diptych::builtin
