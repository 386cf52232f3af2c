// SPDX-License-Identifier: MIT
// The reference's result for one pixel, or for one sample in it.
#pragma once

#include "compare/reference/light/haze.h"
#include "compare/reference/light/lighting.h"
#include "compare/reference/scattering/surface.h"
#include "shared/frame/channel.h"

#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace diptych::reference {

// Without a surface it is background.
struct Pixel {
    std::optional<Surface> surface;
    std::optional<Surface> pane;  // the nearest surface with transmission in front of it
    Shading shading;              // of the nearest opaque surface
    Shading blended;              // of the pane and the blended surfaces in front of it, as visible
    // Light that passes the pane with its haze, or else the opaque surface without, W/(sr m^2).
    glm::dvec3 transmitted{0};
    double hidden = 0;  // fraction of the opaque surface that they hide
    // Largest component of the fraction of light behind that passes a pane, if that is rough or refracts.
    double bent = 0;
    glm::dvec3 lit{0}, unblended{0};
    double sun_visibility = 0;
    double edge_distance = std::numeric_limits<double>::infinity(), sun_radiance = 0, sun_irradiance = 0;
    double local_visibility = 0;
    double local_edge = std::numeric_limits<double>::infinity(), local_radiance = 0;
    double depth = 0;
    Hazed haze;
};

// One pixel, and the contribution of each light to it.
struct PixelLight {
    std::map<Channel, glm::dvec3> channels;  // as in ReferenceImage::channels
    double uncertainty = 0;                  // as in ReferenceImage::uncertainty
    glm::dvec3 unblended{0};                 // lit without blended surfaces, W/(sr m^2)
    // At the pixel's centre, before haze; empty in the background. `lights` is indexed like
    // Request::lights: each light with its shadow, without environment and ambient light. `without_lights`
    // is the rest.
    std::vector<Shading> lights;
    Shading without_lights;
};

}  // namespace diptych::reference
