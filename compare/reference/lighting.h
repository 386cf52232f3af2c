// SPDX-License-Identifier: MIT
// Evaluates every light at a surface, without culling, packing or light lists.
#pragma once

#include "compare/reference/adaptive_sampling.h"
#include "compare/reference/area.h"
#include "compare/reference/brdf.h"
#include "compare/reference/environment.h"
#include "compare/reference/environment_costs.h"
#include "compare/reference/multiscatter.h"
#include "compare/reference/punctual.h"
#include "compare/reference/quadrature.h"
#include "compare/reference/surface.h"
#include "compare/reference/surroundings.h"
#include "shared/scene/model/scene.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace diptych::reference {

// Relative tolerance of integrals without shadows: the change at the last subdivision of their cells. For
// a smooth integrand that is a thousand times the error.
inline constexpr double quadratureError = 2e-6;

struct Shading {
    Reflected reflected;     // from lights and environment, towards the viewer, W/(sr m^2)
    double uncertainty = 0;  // 95 % confidence, of the largest component of `reflected`, W/(sr m^2)
    glm::dvec3 ambient{0};   // reflected ambient light, W/(sr m^2); neither includes emission
    // Only if requested.
    EnvironmentCosts costs{};
    Surroundings surroundings{};
    Reflected environment{};  // the environment's part of `reflected`
    // parts of `reflected` and `ambient`: the clear coat's, and the sheen's
    glm::dvec3 clearcoat{0}, sheen{0};

    glm::dvec3 all() const { return reflected.diffuse + reflected.specular + ambient; }
    Shading& operator+=(const Shading& other) {
        reflected += other.reflected;
        uncertainty += other.uncertainty;
        ambient += other.ambient;
        costs += other.costs;
        surroundings += other.surroundings;
        environment += other.environment;
        clearcoat += other.clearcoat;
        sheen += other.sheen;
        return *this;
    }
    friend Shading operator*(const Shading& a, double b) {
        return {a.reflected * b,    a.uncertainty * b, a.ambient * b,   a.costs * b,
                a.surroundings * b, a.environment * b, a.clearcoat * b, a.sheen * b};
    }
};

class Lighting {
public:
    // `lights` are in world space; `environment` must outlive this; positions become relative to `eye`;
    // `ambient` is uniform radiance; `casters` are the indices of the shadow-casting lights.
    Lighting(std::span<const Light> lights, const Environment* environment, double environment_factor,
             const glm::dvec3& eye, const glm::dvec3& ambient = glm::dvec3(0),
             std::span<const std::size_t> casters = {}, bool shadowed_environment = false,
             Multiscatter multiscatter = Multiscatter::off, double environment_rotation = 0,
             const Falloff& falloff = {});

    // After these calls Shading has costs (unless Multiscatter::walk is used) or surroundings (if
    // `visible` is not empty).
    void takeCosts();
    void takeSurroundings() { takes_surroundings_ = true; }

    // Radiance where no surface is, W/(sr m^2).
    glm::dvec3 background(const glm::dvec3& direction) const {
        return environment_ ? environment_->radiance(direction) : glm::dvec3(0);
    }

    // `visible` is asked for shadow-casting lights only; if empty, there are no shadows. `seed` identifies
    // the shaded surface.
    Shading operator()(const Surface& surface, const Visibility& visible, std::uint64_t seed) const;

    // Radiance towards the viewer under unit irradiance from one direction, 1/sr: f(l, v) n.l of the
    // material with its multiple-scattering terms, its sheen and its clear coat.
    Reflected reflectance(const Surface& surface, const glm::dvec3& to_light) const;

private:
    struct Punctual {
        Light light;
        glm::dvec3 position;
        bool casts;
    };
    struct Emitting {
        Emitter emitter;
        bool casts;
    };
    // Everything under the clear coat.
    Shading underCoat(const Surface& surface, const Visibility& visible, std::uint64_t seed) const;
    // The light of one layer: the material under its sheen and clear coat, or one of these.
    Shading layer(const Surface& surface, Multiscatter multiscatter, const Visibility& visible,
                  std::uint64_t seed) const;
    Shading fromEmitter(const Emitter& emitter, const glm::dvec3& place, const Brdf& brdf,
                        const Visibility& visible, std::uint64_t seed) const;
    // `lobeOnly`: nothing from the base, which is lit by a lightmap.
    Estimated fromEnvironment(const Brdf& brdf, bool lobeOnly, const Visibility& visible,
                              std::uint64_t seed) const;
    // Adds further reflections between microfacets by a random walk (microsurface.h). `base`: the fraction
    // of uniform light that reaches the base, which the layer does not reflect. `single`: radiance of
    // single reflections; the confidence is relative to it.
    struct MoreReflections {
        Shading shading;
        glm::dvec3 base;
    };
    MoreReflections between(const Surface& surface, const Visibility& visible, const glm::dvec3& single,
                            std::uint64_t seed) const;

    std::vector<Punctual> punctual_;
    std::vector<Emitting> emitters_;
    std::optional<EnvironmentLight> environment_;
    std::optional<EnvironmentApproximation> approximation_;
    glm::dvec3 ambient_;
    bool shadowed_environment_, takes_surroundings_ = false;
    Multiscatter multiscatter_;
    Falloff falloff_;
};

}  // namespace diptych::reference
