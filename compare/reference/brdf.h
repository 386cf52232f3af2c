// SPDX-License-Identifier: MIT
// The material model in double, from its definition: Khronos, glTF 2.0 Specification, 2021, appendix B, with
// KHR_materials_ior and KHR_materials_specular.
#pragma once

#include "compare/reference/surface.h"

#include <optional>

namespace diptych::reference {

// What stands for light that is reflected between microfacets (multiscatter.h), for one direction to the
// viewer.
struct Compensation {
    glm::dvec3 dielectric{1}, metal{1};  // factors of the lobes of the two materials that `metallic` mixes
    glm::dvec3 between{0};               // albedo of a Lambertian lobe beside the specular one, of the mix
    // The share of light from any direction that a dielectric's base gets; by appendix B without one.
    std::optional<glm::dvec3> base;
};

// Of light from straight behind a surface without thickness what reaches the viewer, for each component
// (KHR_materials_transmission without its roughness): what the layer lets in and the base neither scatters
// nor absorbs.
glm::dvec3 transmitted(const Surface& surface);

class Brdf {
public:
    explicit Brdf(const Surface& surface, const Compensation& compensation = {});

    // f(l, v) n.l of each lobe, 1/sr; `to_light` is unit. 0 for light from below the shading normal's
    // horizon.
    Reflected operator()(const glm::dvec3& to_light) const;
    // The same of GGX alone, which `specular` is without the lobe beside it.
    glm::dvec3 lobe(const glm::dvec3& to_light) const { return evaluate(to_light).specular; }

    const glm::dvec3& normal() const { return normal_; }
    const glm::dvec3& toViewer() const { return to_viewer_; }
    double alpha() const { return alpha_; }  // GGX width, roughness^2

private:
    Reflected evaluate(const glm::dvec3& to_light) const;

    Compensation compensation_;
    glm::dvec3 normal_, to_viewer_;
    glm::dvec3 albedo_, dielectric_f0_;
    BaseLayer base_layer_;
    double metallic_, scattered_, dielectric_f90_, alpha_, n_dot_v_, lambda_v_;
};

}  // namespace diptych::reference
