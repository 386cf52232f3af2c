// SPDX-License-Identifier: MIT
// The material model in double, from its definition: Khronos, glTF 2.0 Specification, 2021, appendix B,
// KHR_materials_ior, _specular, _clearcoat, _anisotropy, _sheen, _iridescence, _transmission and
// _diffuse_transmission.
#pragma once

#include "compare/reference/scattering/sheen.h"
#include "compare/reference/scattering/surface.h"
#include "compare/reference/scattering/thin_film.h"

#include <glm/vec2.hpp>

#include <cmath>
#include <optional>

namespace diptych::reference {

// Multiple-scattering terms (multiscatter.h) for one view direction.
struct Compensation {
    // factors of the specular lobes of the two materials that `metallic` mixes
    glm::dvec3 dielectric{1}, metal{1};
    glm::dvec3 between{0};  // albedo of an additional Lambertian lobe, mixed by `metallic`
    // Fraction of light that reaches a dielectric's base, from any direction; if unset, appendix B's
    // formula.
    std::optional<glm::dvec3> base;
    // The paths' approximation: Fresnel terms under a film are those at this cosine for every direction.
    std::optional<double> film_cosine = {};
};

// Widths of a GGX lobe, roughness^2. KHR_materials_anisotropy widens it along one direction.
struct Widths {
    double along = 1, across = 1;
    glm::dvec3 x{0}, y{0};  // unit, in the surface: along and across; 0 if isotropic

    bool isotropic() const { return along == across; }
    double mean() const { return isotropic() ? across : std::sqrt(along * across); }
};
Widths widthsOf(const Surface& surface);

// The width in the plane of the normal and a direction: Heitz 2014, equation 80.
double widthTowards(const Widths& widths, const glm::dvec3& direction);

// The same surface with an isotropic lobe of the mean width. It replaces an anisotropic one in
// multiple-scattering terms and in the paths' approximations.
Surface isotropic(const Surface& surface);
Surface isotropic(const Surface& surface, double width);

// The clear coat as a surface of its own: a GGX lobe with F = 1.
Surface coatOf(const Surface& surface);
// Fraction of light that the clear coat reflects instead of the material; 0 without a coat.
double coatWeight(const Surface& surface);
// Radiance of the material's emission through its clear coat, W/(sr m^2). A sheen does not dim it.
glm::dvec3 emitted(const Surface& surface);

// Fraction of light from straight behind a thin surface that reaches the viewer, for each component. It is
// the light that the layer admits and the base neither scatters nor absorbs (KHR_materials_transmission
// without its roughness), and lets through a sheen and a clear coat.
glm::dvec3 transmitted(const Surface& surface);

// The surface seen from behind whose diffuse lobe is what diffuse transmission sends to the viewer: the
// layer takes as much of the light as of light mirrored to the front.
Surface behind(const Surface& surface);

// Reflection by one layer: a sheen (sheenOf()), or a surface without one, and diffuse transmission. Ignores
// a clear coat.
class Brdf {
public:
    explicit Brdf(const Surface& surface, const Compensation& compensation = {});

    // f(l, v) |n.l| of each lobe, 1/sr. Light below the shading normal's horizon is only transmitted.
    // `to_light`: unit.
    Reflected operator()(const glm::dvec3& to_light) const;
    // The GGX or sheen lobe alone: `specular` without Compensation::between.
    glm::dvec3 lobe(const glm::dvec3& to_light) const { return evaluate(to_light).specular; }

    // Relative errors of the diffuse and the specular lobe if float32 turns `to_light` by `angle_error`, rad.
    glm::dvec2 rounding(const glm::dvec3& to_light, double angle_error) const;

    const glm::dvec3& normal() const { return normal_; }
    const glm::dvec3& toViewer() const { return to_viewer_; }
    // Widths of the GGX lobe; 1 for a sheen.
    const Widths& widths() const { return widths_; }
    bool isSheen() const { return sheen_.has_value(); }
    bool transmits() const { return from_behind_ != glm::dvec3(0); }

private:
    Reflected evaluate(const glm::dvec3& to_light) const;
    glm::dvec3 transmit(const glm::dvec3& to_light, double n_dot_l) const;
    glm::dvec3 halfway(const glm::dvec3& to_light) const;
    glm::dvec3 baseUnder(const glm::dvec3& layer) const;

    Compensation compensation_;
    glm::dvec3 normal_, to_viewer_;
    glm::dvec3 albedo_, dielectric_f0_;
    BaseLayer base_layer_;
    double metallic_, dielectric_f90_;
    // Albedos of the base: of light from the front, and of light from behind.
    glm::dvec3 scattered_, from_behind_;
    ThinFilm film_;
    glm::dvec3 sheen_color_;
    std::optional<SheenLobe> sheen_;
    Widths widths_;
    double n_dot_v_, lambda_v_;
};

}  // namespace diptych::reference
