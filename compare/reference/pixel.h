// SPDX-License-Identifier: MIT
// The reference's result for one pixel, or for one sample in it.
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
    Shading shading;    // of the nearest opaque surface
    Shading blended;    // of the blended surfaces in front of it, as visible
    double hidden = 0;  // fraction of the opaque surface that they hide
    glm::dvec3 lit{0}, unblended{0};
    double sun_visibility = 0;
    double edge_distance = std::numeric_limits<double>::infinity(), sun_radiance = 0, sun_irradiance = 0;
    double local_visibility = 0;
    double local_edge = std::numeric_limits<double>::infinity(), local_radiance = 0;
    double depth = 0;
    Hazed haze;
};

}  // namespace diptych::reference
