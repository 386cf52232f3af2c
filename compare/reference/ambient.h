// SPDX-License-Identifier: MIT
// Reflection of light that is equal from all directions.
#pragma once

#include "compare/reference/brdf.h"
#include "compare/reference/surface.h"

namespace diptych::reference {

// Directional albedo of each lobe: the radiance that the surface sends to the viewer under radiance 1 from
// the whole hemisphere, that is the integral of the BRDF, without occlusion, within 5e-6. A viewer below n.v
// = 1e-4 is treated as one at 1e-4.
glm::dvec3 diffuseAlbedo(const Surface& surface, const Compensation& compensation = {});
glm::dvec3 specularAlbedo(const Surface& surface, const Compensation& compensation = {});

}  // namespace diptych::reference
