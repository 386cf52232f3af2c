// SPDX-License-Identifier: MIT
// Air along a ray, integrated by quadrature: what it takes away and what it scatters to the viewer, once.
#pragma once

#include "shared/scene/model/scene.h"

#include <glm/vec3.hpp>

namespace diptych::reference {

// Density falls as exp(-height / scale), at most e^60 times that at height 0.
struct AirKind {
    glm::dvec3 scattering{0}, extinction{0};  // at height 0, 1/m
    double scale = 1;                         // m
};

struct Air {
    AirKind molecules, aerosols;
    double g = 0;       // mean cosine of what aerosols scatter
    double ground = 0;  // world y of height 0, m
    // One height for both kinds, by which the column above height 0 stays what it is (of the components'
    // mean), and the sun's light as it is at the camera's height.
    bool uniform = true;
    const Light* sun = nullptr;  // its irradiance is that above the air; it must outlive this
    glm::dvec3 ambient{0};       // radiance from everywhere, W/(sr m^2)
};

struct Hazed {
    glm::dvec3 transmittance{1}, scattered{0};  // W/(sr m^2)
};

class Haze {
public:
    // `eye`: of the camera, world, m.
    Haze(const Air& air, const glm::dvec3& eye);

    // Over `reach` metres, which may be infinite, from `origin` (relative to the eye) along the unit vector
    // `away`.
    Hazed along(const glm::dvec3& origin, const glm::dvec3& away, double reach) const;

private:
    glm::dvec3 above(double height) const;  // optical depth straight up

    Air air_;
    double eye_height_;
    double sun_up_ = 0;  // sine of the sun's elevation; 0: it gives nothing
    glm::dvec3 to_sun_{0, 1, 0}, irradiance_{0};
    glm::dvec3 sunlight_{0};  // share of it at the camera's height
};

}  // namespace diptych::reference
