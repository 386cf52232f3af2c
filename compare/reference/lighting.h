// SPDX-License-Identifier: MIT
// Every light on one surface, in full: nothing is culled, packed or listed.
#pragma once

#include "compare/reference/area.h"
#include "compare/reference/brdf.h"
#include "compare/reference/environment.h"
#include "compare/reference/quadrature.h"
#include "compare/reference/surface.h"
#include "shared/scene/model/scene.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace diptych::reference {

// What integrals without shadows are taken to, relative to themselves: the change by the last halving of
// their cells, which is a thousand times the error where the integrand is smooth.
inline constexpr double quadratureError = 2e-6;
// What sampling goes on to, relative to what is sampled: half the 95 % confidence interval. And where it ends
// all the same: the pixel's uncertainty says so. Of a light that no sample sees no uncertainty is claimed:
// less than samplingError of it may come through a hole between them.
inline constexpr double samplingError = 0.01;
inline constexpr std::uint32_t mostSamples = 65536;

// Whether light comes through from `distance` metres in a direction; infinite: from beyond everything.
using Visibility = std::function<bool(const glm::dvec3& to_light, double distance)>;

struct Shading {
    Reflected reflected;     // of lights and environment, W/(sr m^2), towards the viewer
    double uncertainty = 0;  // of its largest component, 95 % confidence, W/(sr m^2)
    glm::dvec3 ambient{0};   // reflected of ambient light; emission is in neither

    glm::dvec3 all() const { return reflected.diffuse + reflected.specular + ambient; }
    Shading& operator+=(const Shading& other) {
        reflected += other.reflected;
        uncertainty += other.uncertainty;
        ambient += other.ambient;
        return *this;
    }
    friend Shading operator*(const Shading& a, double b) {
        return {a.reflected * b, a.uncertainty * b, a.ambient * b};
    }
};

class Lighting {
public:
    // World lights and `environment`, which outlives this; `eye` becomes the origin; `ambient` radiance comes
    // from everywhere.
    Lighting(std::span<const Light> lights, const Environment* environment, double environment_factor,
             const glm::dvec3& eye, const glm::dvec3& ambient = glm::dvec3(0));

    // `open` empty: nothing throws a shadow. `seed` names what is shaded, for sampling.
    Shading operator()(const Surface& surface, const Visibility& open, std::uint64_t seed) const;

private:
    struct Punctual {
        Light light;
        glm::dvec3 position;
    };
    Shading fromEmitter(const Emitter& emitter, const glm::dvec3& place, const Brdf& brdf,
                        const Visibility& open, std::uint64_t seed) const;
    Shading fromEnvironment(const Brdf& brdf, const Visibility& open, std::uint64_t seed) const;

    std::vector<Punctual> punctual_;
    std::vector<Emitter> emitters_;
    std::optional<EnvironmentLight> environment_;
    glm::dvec3 ambient_;
};

}  // namespace diptych::reference
