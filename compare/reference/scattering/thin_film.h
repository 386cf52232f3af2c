// SPDX-License-Identifier: MIT
// KHR_materials_iridescence: Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the
// Modeling of Varying Iridescence", as the extension simplifies it.
#pragma once

#include "compare/reference/scattering/surface.h"

#include <glm/vec3.hpp>

namespace diptych::reference {

// A film between air and the base.
struct ThinFilm {
    double weight = 0, ior = 1, thickness = 0;  // nm

    // Fraction of light that the film over a base of this F0 reflects, for each component; up to 1.3 where
    // colours leave Rec. 709. `cosine`: of the angle of incidence.
    glm::dvec3 reflected(double cosine, const glm::dvec3& f0) const;
};
inline ThinFilm filmOf(const Surface& s) {
    return {s.iridescence, s.iridescence_ior, s.iridescence_thickness};
}
inline Surface withoutFilm(const Surface& surface) {
    Surface s = surface;
    s.iridescence = s.iridescence_ior = s.iridescence_thickness = 0;
    return s;
}

}  // namespace diptych::reference
