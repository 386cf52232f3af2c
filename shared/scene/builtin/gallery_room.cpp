// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/gallery.h"
#include "shared/scene/builtin/textures.h"

#include <algorithm>
#include <cmath>

namespace diptych::builtin {
namespace {

// Approximate sky visibility of a floor point, squared for a stronger effect. Vertex colours darken the
// floor around objects, because local lights cast no shadows by default.
float openness(const vec3& p) {
    const auto near = [](double distance, double reach) {
        const double t = std::clamp(distance / reach, 0.0, 1.0);
        return static_cast<float>(t * (2 - t));
    };
    float open = 0.35f + 0.65f * near(std::min({p.x - LEFT, RIGHT - p.x, p.z - FAR_END}), 0.9);
    for (const Footprint& f : {STAGE, KNOT, GEM, VASE, PLANTER}) {
        const double dx = std::max(std::abs(p.x - f.x) - f.half_x, 0.0),
                     dz = std::max(std::abs(p.z - f.z) - f.half_z, 0.0);
        open *= 0.25f + 0.75f * near(std::hypot(dx, dz), 0.55);
    }
    return open;
}

}  // namespace

void addWalls(Room& room) {
    Builder& b = room.b;
    const HeightField tiles = tileHeights(512), bricks = brickHeights(512), plaster = plasterHeights(256);

    const int floor = b.material("floor tiles", {vec3(1), 0, 1});
    b.last().base_color_texture =
        b.texture(colorMap("tile colour", tiles, {40, 38, 40, 255}, {160, 156, 162, 255}, {4, 4, false}, 90));
    b.last().normal_texture = b.texture(normalMap("tile relief", tiles, 3));
    b.last().metallic_roughness_texture =
        b.texture(colorMap("tile polish", tiles, {255, 230, 0, 255}, {255, 62, 0, 255}, {4, 4, false}, 40));
    const double length = NEAR_END - FAR_END, width = RIGHT - LEFT;
    Primitive ground = quad({LEFT, 0, NEAR_END}, {width, 0, 0}, {0, 0, -length}, 58, 106);
    ground = paint(std::move(ground), [](const vec3& p) { return glm::vec4(vec3(openness(p)), 1); });
    b.add("floor", scaleTexcoords(std::move(ground), width / 3.2, length / 3.2), floor);

    const int wall = b.material("bricks", {vec3(1), 0, 0.75f});
    b.last().base_color_texture = b.texture(
        colorMap("brick colour", bricks, {110, 100, 94, 255}, {186, 134, 108, 255}, {4, 8, true}, 110));
    b.last().normal_texture = b.texture(normalMap("brick relief", bricks, 9));
    b.last().occlusion_texture = b.texture(occlusion("brick depths", bricks));
    b.add("brick wall",
          scaleTexcoords(quad({LEFT, 0, NEAR_END}, {0, 0, -length}, {0, CEILING, 0}), length / 1.6,
                         CEILING / 1.6),
          wall);

    const TextureSlot soft = b.texture(normalMap("plaster relief", plaster, 12));
    const int endWall = b.material("plum plaster", {{0.2f, 0.1f, 0.14f}, 0, 0.7f});
    b.last().normal_texture = soft;
    b.add("end wall", scaleTexcoords(quad({LEFT, 0, FAR_END}, {width, 0, 0}, {0, CEILING, 0}), 6, 3),
          endWall);
    const int arcade = b.material("sand plaster", {{0.55f, 0.47f, 0.38f}, 0, 0.65f});
    b.last().normal_texture = soft;
    for (int i = 0; i < 5; ++i)
        b.add("arch", archway(3.2, CEILING, 0.6, 2.2, 2.2, 32), arcade,
              at(RIGHT, 0, NEAR_END - 1.6 - 3.2 * i) * rotated(-90));
    const int outside = b.material("evening sky", {vec3(0), 0, 1, vec3(0.55f)});
    b.last().emissive_texture = b.texture(dusk("evening sky", 512), 1,
                                          {.wrap_s = Wrap::mirrored_repeat, .wrap_t = Wrap::clamp_to_edge});
    const Primitive sky = quad({RIGHT + 9, -2, FAR_END - 32}, {0, 0, 44}, {0, 13, 0});
    b.add("evening sky", scaleTexcoords(sky, 2, 1), outside);

    const int ceiling = b.material("ceiling", {{0.1f, 0.09f, 0.09f}, 0, 0.9f});
    b.add("ceiling", quad({LEFT, CEILING, FAR_END}, {width, 0, 0}, {0, 0, length}), ceiling);
    for (int i = 0; i < 8; ++i) {
        const double z = NEAR_END - 1.6 - 2.0 * i;
        b.add("beam", box({width, 0.34, 0.26}, 0.03), room.dark_wood,
              dvec3((LEFT + RIGHT) / 2, CEILING - 0.17, z));
        if (i % 2 == 0)
            b.add("pilaster", box({0.3, CEILING, 0.55}, 0.03), room.stone,
                  dvec3(LEFT + 0.12, CEILING / 2, z));
    }
}

}  // namespace diptych::builtin
