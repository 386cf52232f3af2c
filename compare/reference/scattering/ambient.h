// SPDX-License-Identifier: MIT
// Reflection of uniform light from all directions.
#pragma once

#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/surface.h"

namespace diptych::reference {

// Directional albedo of each lobe: radiance toward the viewer under unit radiance from the hemisphere,
// without occlusion.
// It is the integral of the BRDF, accurate to 5e-6, of anisotropic lobes and sheens to 2e-5, under a thin
// film to 2e-4, for n.v below 0.05 to 4e-4. n.v is clamped to at least 1e-4.
glm::dvec3 diffuseAlbedo(const Surface& surface, const Compensation& compensation = {});
glm::dvec3 specularAlbedo(const Surface& surface, const Compensation& compensation = {});

}  // namespace diptych::reference
