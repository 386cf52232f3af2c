// SPDX-License-Identifier: MIT
// Skies whose light is known, and Settings to draw under them.
#pragma once

#include "tests/image/scenes.h"

#include <glm/common.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace diptych::tests {

inline const std::vector<Channel> shown{Channel::lit,         Channel::lit_diffuse,     Channel::lit_specular,
                                        Channel::lit_ambient, Channel::lit_environment, Channel::material_id};

inline Settings underSky(Size size = {16, 16}) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = size;
    settings.ibl_samples = 32;
    return settings;
}

inline Environment constantSky(float radiance) {
    return {"sky", Image(8, 4, 3, radiance)};
}

// Each of +X, -X, +Y, -Y, +Z, -Z has its own colour, within 45 degrees.
inline const std::array<glm::vec3, 6> painted{
    {{1, 0, 0}, {0, 1, 1}, {0, 1, 0}, {1, 0, 1}, {0, 0, 1}, {1, 1, 0}}};
inline const std::array<glm::vec3, 6> axes{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
inline std::size_t axisOf(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return static_cast<std::size_t>(2 * axis + (d[axis] < 0 ? 1 : 0));
}
inline Environment paintedSky() {
    Environment sky{"painted", Image(64, 32, 3)};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            // scene.h: azimuth 0 at -Z, positive towards +X.
            const double azimuth = 2 * std::numbers::pi * (x + 0.5) / 64 - std::numbers::pi,
                         polar = std::numbers::pi * (y + 0.5) / 32;
            const glm::vec3 color = painted[axisOf({std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                                    -std::sin(polar) * std::cos(azimuth)})];
            for (int c = 0; c < 3; ++c) sky.radiance.at(x, y, c) = color[c];
        }
    return sky;
}

}  // namespace diptych::tests
