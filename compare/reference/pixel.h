// SPDX-License-Identifier: MIT
// What the reference knows of one pixel, or of one place in it.
#pragma once

#include "compare/reference/haze.h"
#include "compare/reference/lighting.h"
#include "compare/reference/surface.h"

#include <limits>
#include <optional>

namespace diptych::reference {

// Without a surface it is background.
struct Pixel {
    std::optional<Surface> surface;
    Shading shading;    // of the nearest surface that is not blended
    Shading blended;    // of those in front of it, as seen
    double hidden = 0;  // the share of it that they hide
    glm::dvec3 lit{0}, unblended{0};
    double sun_visibility = 0;
    double edge_distance = std::numeric_limits<double>::infinity(), sun_radiance = 0, sun_irradiance = 0;
    double local_visibility = 0;
    double local_edge = std::numeric_limits<double>::infinity(), local_radiance = 0;
    double depth = 0;
    Hazed haze;
};

}  // namespace diptych::reference
