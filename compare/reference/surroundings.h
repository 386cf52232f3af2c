// SPDX-License-Identifier: MIT
// What geometry hides of light from everywhere, which neither path models.
#pragma once

#include "compare/reference/brdf.h"
#include "compare/reference/environment.h"

#include <cstdint>
#include <functional>

namespace diptych::reference {

// Whether light arrives unoccluded from `distance` metres in the direction `to_light`; infinite: from
// outside the scene.
using Visibility = std::function<bool(const glm::dvec3& to_light, double distance)>;

// Luminance of what a surface sends to the viewer of environment and ambient light, W/(sr m^2).
struct Surroundings {
    double all = 0, hidden = 0;  // hidden: of all, what comes from where geometry is

    Surroundings& operator+=(const Surroundings& other) {
        all += other.all;
        hidden += other.hidden;
        return *this;
    }
    friend Surroundings operator*(const Surroundings& a, double b) { return {a.all * b, a.hidden * b}; }
};

// By 96 rays: a share of half is known to some 0.05 at one surface, and that of many by the root of their
// number better. `environment`: or nullptr; with `lobeOnly` the base reflects nothing of it. `ambient`:
// radiance from everywhere. `seed`: of this surface.
Surroundings surroundingsOf(const Brdf& brdf, const EnvironmentLight* environment, bool lobeOnly,
                            const glm::dvec3& ambient, const Visibility& visible, std::uint64_t seed);

}  // namespace diptych::reference
