// SPDX-License-Identifier: MIT
// Participating medium along a ray, by quadrature: transmittance and single scattering toward the viewer.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

namespace diptych::reference {

// Density falls as exp(-height / scale); it is at most e^60 times the density at height 0.
struct AirKind {
    glm::dvec3 scattering{0}, extinction{0};  // at height 0, 1/m
    double scale = 1;                         // m
};

struct Air {
    AirKind molecules, aerosols;
    double g = 0;       // mean cosine of aerosol scattering
    double ground = 0;  // world y of height 0, m
    // One scale height for both kinds, which preserves the column above height 0 (mean over components);
    // sunlight is constant, as at the camera's height.
    bool uniform = true;
    const Light* sun = nullptr;  // its irradiance is above the atmosphere; must outlive this
    glm::dvec3 ambient{0};       // uniform radiance, W/(sr m^2)
};

struct Hazed {
    glm::dvec3 transmittance{1}, scattered{0};  // W/(sr m^2)
};

class Haze {
public:
    // `eye`: camera position, world, m.
    Haze(const Air& air, const glm::dvec3& eye);

    // Over `reach` metres (may be infinite) from `origin`, relative to the eye, along the unit vector
    // `away`.
    Hazed along(const glm::dvec3& origin, const glm::dvec3& away, double reach) const;

private:
    glm::dvec3 above(double height) const;  // optical depth toward the zenith

    Air air_;
    double eye_height_;
    double sun_up_ = 0;  // sine of the sun's elevation; 0: no sunlight
    glm::dvec3 to_sun_{0, 1, 0}, irradiance_{0};
    glm::dvec3 sunlight_{0};  // transmittance of sunlight at the camera's height
};

}  // namespace diptych::reference
