// SPDX-License-Identifier: MIT
// The reference renderer: direct light in double precision, written from the definitions. It uses no
// Vulkan, no shader and no code of the paths.
#pragma once

#include "compare/reference/pixel.h"
#include "compare/reference/request.h"
#include "shared/frame/channel.h"
#include "shared/image/image.h"

#include <cstdint>
#include <map>
#include <vector>

namespace diptych::reference {

struct ReferenceImage {
    // All supported channels; background as in a Frame
    std::map<Channel, Image> channels;
    // litModes of the surfaces of Request::decoded; positions, visibility and blended surfaces as in
    // `channels`.
    std::map<Channel, Image> decoded;
    // Uncertainty of lit, in its unit: half the 95 % confidence interval of sampling, plus the quadrature
    // error. Empty if 0 everywhere.
    Image uncertainty;
    // Shading::rounding beyond everywhereRounded of the light, W x H x 4 (roundingOf()). Empty if 0
    // everywhere.
    Image rounding;
    // If a sun casts shadows, W x H x 3. First the distance from its shadow's boundary, m across the light
    // (shadow_edge.h; infinite where the surface faces away). Then the largest component of its unshadowed
    // reflected radiance, W/(sr m^2), and the luminance of its unshadowed irradiance, W/m^2.
    Image shadow_edge;
    // If points or spots cast shadows, W x H x 2. First the distance to the nearest shadow boundary, as a
    // fraction of the distance from the light. Then the sum of their unshadowed reflected radiance, as
    // above.
    Image local_shadow_edge;
    // If materials blend or transmit, W x H x 3: the fraction of the background that these surfaces hide,
    // Pixel::bent, and, where that is not 0, the largest component of Pixel::transmitted.
    Image blended;
    // If materials blend, W x H x 3: lit without blended surfaces.
    Image unblended;
    // If requested, for the environment's light, W x H x 9: EnvironmentCosts' diffuse, split, sampled,
    // wider and lobe; W/(sr m^2).
    Image environment_costs;
    // If requested, W x H x 2: all and hidden of Surroundings.
    Image surroundings;
    // Fraction of the tiles rendered by an earlier command, and the time that took, s on the clock with
    // all cores busy.
    double resumed_fraction = 0, resumed_seconds = 0;
};

// The channels that mode surface takes as input: captured by a path without any encoding, at one sample.
// `layers`: of the scene's materials, Requirements::layers; the channels of other layers are not needed.
std::vector<Channel> surfaceChannels(std::uint32_t layers);

// Renders the image, multithreaded. The result does not depend on the number of threads or on
// interruptions. Throws std::runtime_error, one line, if finished tiles cannot be saved.
ReferenceImage draw(const Request& request);

// Renders one pixel of the image of draw(). Its surface is lit once for each light.
PixelLight drawPixel(const Request& request, int x, int y);

}  // namespace diptych::reference
