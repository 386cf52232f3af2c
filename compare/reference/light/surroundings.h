// SPDX-License-Identifier: MIT
// Occlusion of environment and ambient light by geometry, which neither path models.
#pragma once

#include "compare/reference/light/environment.h"
#include "compare/reference/scattering/brdf.h"

#include <cstdint>
#include <functional>

namespace diptych::reference {

// Whether light arrives unoccluded from `distance` metres in the direction `to_light`; infinite: from
// outside the scene.
using Visibility = std::function<bool(const glm::dvec3& to_light, double distance)>;

// Luminance of the environment and ambient light that a surface reflects to the viewer, W/(sr m^2).
struct Surroundings {
    double all = 0, hidden = 0;  // hidden: the part of `all` that geometry blocks

    Surroundings& operator+=(const Surroundings& other) {
        all += other.all;
        hidden += other.hidden;
        return *this;
    }
    friend Surroundings operator*(const Surroundings& a, double b) { return {a.all * b, a.hidden * b}; }
};

// Traces 96 rays: at one surface a fraction of one half is accurate to about 0.05; the error of a mean
// over n surfaces falls by sqrt(n). `environment`: may be nullptr; with `lobeOnly` the base reflects none
// of it. `ambient`: uniform radiance. `seed`: of this surface.
Surroundings surroundingsOf(const Brdf& brdf, const EnvironmentLight* environment, bool lobeOnly,
                            const glm::dvec3& ambient, const Visibility& visible, std::uint64_t seed);

}  // namespace diptych::reference
