// SPDX-License-Identifier: MIT
// The material model in double, from its definition: Khronos, glTF 2.0 Specification, 2021, appendix B, with
// KHR_materials_ior and KHR_materials_specular.
#pragma once

#include "compare/reference/surface.h"

namespace diptych::reference {

class Brdf {
public:
    explicit Brdf(const Surface& surface);

    // f(l, v) n.l of each lobe, 1/sr; `to_light` is unit. 0 for light from below the shading normal's
    // horizon.
    Reflected operator()(const glm::dvec3& to_light) const;

    const glm::dvec3& normal() const { return normal_; }
    const glm::dvec3& toViewer() const { return to_viewer_; }
    double alpha() const { return alpha_; }  // GGX width, roughness^2

private:
    glm::dvec3 normal_, to_viewer_;
    glm::dvec3 albedo_, dielectric_f0_;
    double metallic_, dielectric_f90_, alpha_, n_dot_v_, lambda_v_;
};

}  // namespace diptych::reference
