// SPDX-License-Identifier: MIT
// The reference renderer that paths are compared with: direct light in double precision, written from the
// definitions. It uses no Vulkan, no shader and none of the paths' code.
#pragma once

#include "compare/reference/lighting.h"
#include "compare/reference/request.h"
#include "shared/image/image.h"

#include <glm/vec3.hpp>

#include <map>
#include <vector>

namespace diptych::reference {

struct Picture {
    std::map<int, Image> channels;  // by debug mode number, all that it can make; background as in a Frame
    // litModes shaded from Request::decoded, with positions, visibility and what is blended as in `channels`.
    std::map<int, Image> decoded;
    // Of lit, in its unit: half the 95 % confidence interval of what was sampled, plus the error that
    // quadrature left. Empty if it is 0 everywhere.
    Image uncertainty;
    // Where a sun casts, W x H x 3: the distance from the edge of its shadow, m across the light
    // (shadow_edge.h; infinite where the surface is turned from it), the largest component of what the
    // surface would reflect of it unshadowed, W/(sr m^2), and the luminance of what would arrive, W/m^2.
    Image shadow_edge;
    // Where points or spots cast, W x H x 2: the same of the nearest edge of their shadows, as a share of the
    // distance from the light, and of what all of them add.
    Image local_shadow_edge;
    // Where materials blend, W x H x 1: the share that what is blended hides of what lies behind it.
    Image blended;
    // Where materials blend, W x H x 3: lit without what is blended.
    Image unblended;
    // Where it was asked for, of the environment's light, W x H x 9: EnvironmentCosts, its diffuse, its
    // split, sampled, wider and lobe; W/(sr m^2).
    Image environment_costs;
    // Likewise, W x H x 2: Surroundings, all and hidden.
    Image surroundings;
    // What an earlier command had drawn and kept: its share of the tiles, and how long drawing it took on the
    // clock with all cores at work, s.
    double kept_share = 0, kept_seconds = 0;
};

// The channels that mode surface takes as its input: as captured by a path without any encoding, at one
// sample.
std::vector<int> surfaceChannels();

// Draws the picture, multithreaded. The result does not depend on the number of threads or on interruptions.
// Throws std::runtime_error, one line, if finished tiles cannot be kept.
Picture draw(const Request& request);

// One pixel, and what each light alone sends from it.
struct PixelLight {
    std::map<int, glm::dvec3> channels;  // by debug mode number, as Picture::channels at the pixel
    double uncertainty = 0;              // as Picture::uncertainty there
    glm::dvec3 unblended{0};             // lit without what is blended, W/(sr m^2)
    // At the pixel's middle, before any haze; empty in the background. By the places of Request::lights: each
    // light with its shadow and without the environment and ambient light; and all that without lights.
    std::vector<Shading> lights;
    Shading without_lights;
};

// The pixel of the picture that draw() makes, by itself. Its surface is lit once for each light.
PixelLight drawPixel(const Request& request, int x, int y);

}  // namespace diptych::reference
