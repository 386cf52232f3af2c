// SPDX-License-Identifier: MIT
// Light that is the same from everywhere.
#pragma once

#include "compare/reference/surface.h"

namespace diptych::reference {

// What each lobe of the surface sends to the viewer of radiance 1 from all of the hemisphere: the integral of
// the BRDF, unoccluded, within 5e-6. A viewer below n.v = 1e-4 is taken as one that stands there.
glm::dvec3 diffuseAlbedo(const Surface& surface);
glm::dvec3 specularAlbedo(const Surface& surface);

}  // namespace diptych::reference
