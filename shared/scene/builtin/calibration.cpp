// SPDX-License-Identifier: MIT
// Charts that reveal how a renderer interprets its inputs. Each chart has its own material, so that
// material_id finds it. Expected values follow from numbers: an emitter shows its radiance. A white
// Lambertian surface shows E / pi under one light. A tilted one shows the light from a sky of six colours.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>

namespace diptych::builtin {
namespace {

// A square of `side` metres around `middle` that faces the camera, rotated about the view direction.
Primitive square(const glm::dvec3& middle, double side, double degrees = 0) {
    const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    const glm::dvec3 right = glm::dvec3(c, s, 0) * side, up = glm::dvec3(-s, c, 0) * side;
    return quad(middle - 0.5 * (right + up), right, up);
}

// Black, so it shows only its emission.
int emitter(Builder& b, const std::string& name, const glm::vec3& radiance) {
    const int material = b.material(name, {glm::vec3(0), 0, 1, radiance});
    b.last().specular = 0;
    return material;
}

// White Lambertian without specular reflection.
int lambert(Builder& b, const std::string& name) {
    const int material = b.material(name, {glm::vec3(1), 0, 1});
    b.last().specular = 0;
    return material;
}

TextureImage plain(const std::string& name, const Rgba8& texel) {
    TextureImage image{name, 4, 4, {}};
    for (int i = 0; i < 16; ++i) image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
    return image;
}

// A face tilted by 65 degrees from the camera towards the direction `side`.
void tilted(Builder& b, const std::string& name, const glm::dvec3& middle, const glm::dvec3& side) {
    const double angle = glm::radians(65.0);
    const glm::dvec3 normal = std::cos(angle) * glm::dvec3(0, 0, 1) + std::sin(angle) * side;
    const glm::dvec3 along = std::sin(angle) * glm::dvec3(0, 0, 1) - std::cos(angle) * side;
    // cross(right, up) is the normal.
    const glm::dvec3 across = glm::cross(along, normal);
    b.add(name, quad(middle - 0.5 * across - 0.75 * along, across, 1.5 * along), lambert(b, name));
}

// A sky with a lobe of another colour along each of the six axis directions, so that no rotation or
// reflection maps it to itself. Some radiances are far above 1, beyond 8-bit images. The lobes are small,
// so white faces stay below 1.
Environment sky() {
    struct Lamp {
        glm::dvec3 towards, radiance;
    };
    const std::array lamps{Lamp{{1, 0, 0}, {8, 0.4, 0.4}},   Lamp{{-1, 0, 0}, {0.3, 3, 0.3}},
                           Lamp{{0, 0, 1}, {0.4, 0.5, 5}},   Lamp{{0, 0, -1}, {2, 2, 0.1}},
                           Lamp{{0, 1, 0}, {0.9, 0.9, 0.9}}, Lamp{{0, -1, 0}, {0.6, 0.2, 0.7}}};
    constexpr int width = 64, height = 32;
    Environment made{"calibration", Image(width, height, 3)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double azimuth = 2 * glm::pi<double>() * (x + 0.5) / width - glm::pi<double>(),
                         polar = glm::pi<double>() * (y + 0.5) / height;
            const glm::dvec3 direction(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                       -std::sin(polar) * std::cos(azimuth));
            glm::dvec3 radiance(0);
            for (const Lamp& lamp : lamps) {
                // The lobe falls to half at 12 degrees.
                radiance += lamp.radiance * std::pow(std::max(0.0, glm::dot(direction, lamp.towards)), 32);
            }
            for (int c = 0; c < 3; ++c) made.radiance.at(x, y, c) = static_cast<float>(radiance[c]);
        }
    return made;
}

}  // namespace

void calibration(Builder& b) {
    b.camera("front", {0, 0, 10}, {0, 0, 0}, 40, 0.1, 100);
    // Position marks without symmetry: any rotation or reflection of the image moves them.
    constexpr std::array marks{glm::dvec2(-5.6, 2.8),  glm::dvec2(-2.0, 2.9), glm::dvec2(2.9, 2.8),
                               glm::dvec2(5.6, 2.0),   glm::dvec2(5.5, -2.8), glm::dvec2(1.2, -2.9),
                               glm::dvec2(-3.4, -2.8), glm::dvec2(-5.7, -1.4)};
    for (std::size_t i = 0; i < marks.size(); ++i)
        b.add("mark", square({marks[i], 0}, 0.5, 20), emitter(b, fmt::format("mark {}", i), glm::vec3(1)));
    // A grey ramp, which shows the transfer curve of the output.
    constexpr std::array ramp{0.02f, 0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 1.0f, 2.0f, 4.0f, 8.0f};
    for (std::size_t i = 0; i < ramp.size(); ++i)
        b.add("ramp", square({0.8 * (static_cast<double>(i) - 5), 1.6, 0}, 0.6),
              emitter(b, fmt::format("ramp {:g}", ramp[i]), glm::vec3(ramp[i])));
    // Primaries.
    constexpr std::array names{"red", "green", "blue"};
    for (int c = 0; c < 3; ++c) {
        glm::vec3 radiance(0);
        radiance[c] = 0.5f;
        b.add(names[static_cast<std::size_t>(c)], square({-4.0 + 1.0 * c, 0.5, 0}, 0.7),
              emitter(b, names[static_cast<std::size_t>(c)], radiance));
    }
    // Texels of 128. As sRGB colour they mean 0.2159; as metallic they mean 0.502. The data texture is
    // smooth, so that almost none of its metallic reflection, which differs between renderers, is visible.
    const int colour = emitter(b, "colour texture", glm::vec3(1));
    b.last().emissive_texture = b.texture(plain("128", {128, 128, 128, 255}));
    b.add("colour texture", square({-1, 0.5, 0}, 0.7), colour);
    const int number = b.material("data texture", {glm::vec3(1), 1, 0.15f});
    b.last().specular = 0;
    b.last().metallic_roughness_texture = b.texture(plain("metallic 128", {255, 255, 128, 255}));
    b.add("data texture", square({1.2, 0.4, 0}, 0.8), number);
    // Lit by lights of every type.
    b.add("white", square({2.6, 0.4, 0}, 1.0), lambert(b, "white"));
    // Each is placed where the camera sees it at the least grazing angle.
    tilted(b, "right", {-3.2, -1, 0}, {1, 0, 0});
    tilted(b, "up", {-1.5, -1, 0}, {0, 1, 0});
    b.add("front", square({0.1, -1.1, 0}, 0.9), lambert(b, "front"));
    tilted(b, "down", {1.6, -1, 0}, {0, -1, 0});
    tilted(b, "left", {3.3, -1, 0}, {-1, 0, 0});

    // Dim: an image that clips at 1 could store about three times as much.
    b.sun({0.3, -0.4, -1}, glm::vec3(1), 0.5f);
    b.point({2.6, 0.4, 3}, glm::vec3(1), 2.5f);
    b.spot({2.6, 0.4, 4}, {2.6, 0.4, 0}, glm::vec3(1), 4, Builder::noEnd, {20, 30});
    b.rect({2.6, 0.4, 3}, {2.6, 0.4, 0}, glm::vec3(1), 2.5f);
    b.scene.environment = sky();
}

}  // namespace diptych::builtin
