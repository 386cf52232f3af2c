// SPDX-License-Identifier: MIT
// The reference's surface and reflected light: double precision, world axes with the camera as origin,
// metres, linear Rec. 709.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/scene/model/axes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace diptych::reference {

// Bounds of the material model (compare/reference/README.md, "The model"), restated independently. A perfect
// mirror under a punctual light is a delta function that cannot be sampled. A normal map may turn a visible
// surface away from the viewer.
inline constexpr double min_roughness = 0.045, min_n_dot_v = 1e-4;

inline double squared(double x) {
    return x * x;
}

struct Surface {
    glm::dvec3 position{0};
    glm::dvec3 to_viewer{0, 0, 1};         // unit
    glm::dvec3 normal{0, 0, 1};            // unit, shading
    glm::dvec3 geometric_normal{0, 0, 1};  // unit, of the triangle, on the viewer's side
    glm::dvec3 albedo{0};                  // base colour
    double metallic = 0, roughness = 1;    // perceptual roughness
    double occlusion = 1;
    glm::dvec3 emission{0};       // W/(sr m^2)
    glm::dvec3 lightmap{0};       // irradiance / pi, W/(sr m^2)
    bool lightmapped = false;     // whether the material has a lightmap, which may be black here
    glm::dvec3 dielectric_f0{0};  // of the dielectric layer alone; the BRDF mixes it with the metal's
    double dielectric_f90 = 1;
    double transmission = 0;  // fraction of the light entering the base that is transmitted, not scattered
    // KHR_materials_clearcoat: weight, perceptual roughness and unit shading normal; 0 without a coat.
    double clearcoat = 0, clearcoat_roughness = 0;
    glm::dvec3 clearcoat_normal{0};
    // KHR_materials_anisotropy: strength, and the unit direction in which highlights stretch, perpendicular
    // to `normal`, either sign; 0 where isotropic.
    double anisotropy = 0;
    glm::dvec3 anisotropy_direction{0};
    // KHR_materials_sheen: colour and perceptual roughness; 0 without one.
    glm::dvec3 sheen_color{0};
    double sheen_roughness = 0;
    // KHR_materials_iridescence: weight, index and thickness (nm) of the thin film; 0 without one.
    double iridescence = 0, iridescence_ior = 0, iridescence_thickness = 0;
    // KHR_materials_transmission's slab: KHR_materials_ior (0: infinite), thickness (m, world; 0: a thin
    // wall), KHR_materials_volume's colour and distance (m; 0: nothing is absorbed), 20 / Abbe number.
    double ior = 1.5, thickness = 0;
    glm::dvec3 attenuation_color{1};
    double attenuation_distance = 0, dispersion = 0;
    // KHR_materials_diffuse_transmission: weight and colour; 0 without it.
    double diffuse_transmission = 0;
    glm::dvec3 diffuse_transmission_color{0};
    BaseLayer base_layer = BaseLayer::max;
    int material = -1;
    glm::dvec2 texcoord{0};
    // Tangent frame and value of a normal map; 0 without one or if its scale is 0.
    glm::dvec3 tangent{0};         // unit, world
    double handedness = 0;         // bitangent = handedness * cross(normal, tangent)
    glm::dvec3 tangent_normal{0};  // unit, tangent space

    // Sets the anisotropy, with the part of `direction` that is perpendicular to `normal`; isotropic where
    // that vanishes.
    void stretch(double strength, const glm::dvec3& direction) {
        anisotropy_direction = unitOr(direction - normal * glm::dot(normal, direction), glm::dvec3(0));
        anisotropy = anisotropy_direction == glm::dvec3(0) ? 0 : strength;
        if (!(anisotropy > 0)) anisotropy_direction = glm::dvec3(0);
    }
};

// Fraction of light, at most 1, that a layer reflecting `layer` takes from the base, for each component.
inline glm::dvec3 lostToLayer(BaseLayer rule, const glm::dvec3& layer) {
    const glm::dvec3 lost =
        rule == BaseLayer::component ? layer : glm::dvec3(std::max({layer.r, layer.g, layer.b}));
    return glm::min(lost, glm::dvec3(1));
}

// A quantity for each lobe: radiance, W/(sr m^2), or a factor of it. `transmitted`: of light from behind, by
// diffuse transmission.
struct Reflected {
    glm::dvec3 diffuse{0}, specular{0}, transmitted{0};

    glm::dvec3 sum() const { return diffuse + specular + transmitted; }
    Reflected& operator+=(const Reflected& other) {
        diffuse += other.diffuse;
        specular += other.specular;
        transmitted += other.transmitted;
        return *this;
    }
    friend Reflected operator+(Reflected a, const Reflected& b) { return a += b; }
    friend Reflected operator-(const Reflected& a, const Reflected& b) { return a + b * -1.0; }
    friend Reflected operator*(const Reflected& a, double b) { return a * glm::dvec3(b); }
    friend Reflected operator*(const Reflected& a, const glm::dvec3& b) {
        return {a.diffuse * b, a.specular * b, a.transmitted * b};
    }

    // The largest component of the sum, by magnitude; errors are relative to it.
    double size() const {
        const glm::dvec3 all = glm::abs(sum());
        return std::max({all.x, all.y, all.z});
    }
};

}  // namespace diptych::reference
