// SPDX-License-Identifier: MIT
// Test scenes with baked lighting (lightmaps).
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace diptych::builtin {
namespace {

struct Ball {
    glm::dvec3 centre;
    double radius;
};

// Irradiance / pi at a point under a sky of radiance 1 with black balls. Each ball blocks its
// configuration factor, (r / d)^2 cos (Howell, Menguec and Siegel 2010); it must be wholly above the
// horizon of the point.
double skyLight(const glm::dvec3& position, const glm::dvec3& normal, std::span<const Ball> balls) {
    double fraction = 1;
    for (const Ball& ball : balls) {
        const glm::dvec3 way = ball.centre - position;
        const double distance = std::sqrt(glm::dot(way, way));
        fraction -= ball.radius * ball.radius / (distance * distance) *
                    std::max(glm::dot(way, normal) / distance, 0.0);
    }
    return std::max(fraction, 0.0);
}

// Makes a lightmap; texel(u, v) is linear radiance, u to the right and v down.
template <class Texel>
TextureImage floats(const std::string& name, int size, const Texel& texel) {
    TextureImage image{name, size, size, {}};
    image.largest = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::vec3 light(texel((x + 0.5) / size, (y + 0.5) / size));
            image.rgba32.insert(image.rgba32.end(), {light.r, light.g, light.b, 1});
            image.largest = std::max({image.largest, light.r, light.g, light.b});
        }
    return image;
}

TextureImage ballLight() {
    TextureImage image{"ball light", 32, 32, {}};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {  // x runs down the ball
            for (const int top : {200, 215, 235})
                image.rgba.push_back(static_cast<std::uint8_t>(top - 5 * x));
            image.rgba.push_back(255);
        }
    return image;
}

}  // namespace

// A floor and a wall under a sky that two balls partly hide, and a stripe of 40 W/(sr m^2) along the
// wall's foot. The floor's lightmap has floats far beyond the range of 8 bits; those of the balls have 8
// bits and an intensity of 1.5. In front are five tiles: without a lightmap, with one, with an occlusion
// map too, metallic (reflects no baked light), and unlit. A weak sun and a point light light everything as
// well.
void lightmaps(Builder& b) {
    b.camera("front", {0, 2.4, 6.5}, {0, 0.7, 0}, 38, 0.1, 100);
    constexpr std::array balls{Ball{{-1.2, 0.7, 0}, 0.7}, Ball{{1.1, 0.5, 0.4}, 0.5}};
    constexpr Sampler clamped{.wrap_s = Wrap::clamp_to_edge, .wrap_t = Wrap::clamp_to_edge};
    const auto lit = [&](const std::string& name, const Surface& surface, TextureImage image,
                         float intensity) {
        const int material = b.material(name, surface);
        b.last().lightmap_texture = b.texture(std::move(image), 1, clamped);
        b.last().lightmap_texture.texcoord = 1;
        b.last().lightmap_intensity = intensity;
        return material;
    };
    const glm::dvec3 sky(0.55, 0.7, 0.9), glow(40, 9, 2);

    // The lightmap's (u, v) of withTurnedSet() equals (1 - v, u) of the first UV set.
    const int floor = lit("floor", {glm::vec3(0.6f), 0, 0.5f},
                          floats("floor light", 128,
                                 [&](double u, double v) {
                                     const glm::dvec3 position(-4 + 8 * (1 - v), 0, -2 + 5 * u);
                                     const double near = std::max(0.0, 1 - (position.z + 2) / 0.5);
                                     return sky * skyLight(position, {0, 1, 0}, balls) + glow * near * near;
                                 }),
                          1);
    b.add("floor", withTurnedSet(quad({-4, 0, 3}, {8, 0, 0}, {0, 0, -5})), floor);
    const int wall = lit(
        "wall", {{0.7f, 0.6f, 0.5f}, 0, 0.8f},
        floats("wall light", 64,
               [&](double u, double v) {
                   const glm::dvec3 position(-4 + 8 * (1 - v), 3 * (1 - u), -2);
                   return sky * 0.5 * skyLight(position, {0, 0, 1}, balls) + glow * 1e-3 * (3 - position.y);
               }),
        1);
    b.add("wall", withTurnedSet(quad({-4, 0, -2}, {8, 0, 0}, {0, 3, 0})), wall);

    for (const Ball& ball : balls) {
        const int material = lit("ball", {{0.8f, 0.3f, 0.2f}, 0, 0.3f}, ballLight(), 1.5f);
        b.add("ball", withTurnedSet(sphere(ball.radius)), material, ball.centre);
    }

    const TextureSlot depths = b.texture(diptych::occlusion("depths", brickHeights(128)));
    for (int i = 0; i < 5; ++i) {
        const int tile =
            lit("tile", {{0.5f, 0.6f, 0.4f}, i == 3 ? 1.0f : 0.0f, 0.4f},
                floats("tile light", 16, [&](double u, double v) { return sky * (u + 2 * v); }), 0.7f);
        if (i == 0) b.last().lightmap_texture = {};
        if (i == 2) b.last().occlusion_texture = depths;
        b.last().unlit = i == 4;
        b.add("tile", withTurnedSet(quad({-0.35, 0, 0}, {0.7, 0, 0}, {0, 0.6, -0.4})), tile,
              glm::dvec3(0.85 * (i - 2), 0.02, 2.6));
    }
    b.sun({-0.4, -1, -0.6}, {1.0f, 0.95f, 0.9f}, 0.5f);
    b.point({0, 1.8, 1.5}, {1.0f, 0.8f, 0.6f}, 1.5f, 5);
}

}  // namespace diptych::builtin
