// SPDX-License-Identifier: MIT
// Lights a surface by every light in full: without culling, packing or light lists.
#pragma once

#include "compare/reference/area.h"
#include "compare/reference/brdf.h"
#include "compare/reference/environment.h"
#include "compare/reference/environment_costs.h"
#include "compare/reference/multiscatter.h"
#include "compare/reference/punctual.h"
#include "compare/reference/quadrature.h"
#include "compare/reference/surface.h"
#include "compare/reference/surroundings.h"
#include "compare/reference/until_confident.h"
#include "shared/scene/model/scene.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace diptych::reference {

// Relative tolerance of integrals without shadows: the change by the last subdivision of their cells, which
// is a thousand times the error where the integrand is smooth.
inline constexpr double quadratureError = 2e-6;

struct Shading {
    Reflected reflected;     // from lights and environment, towards the viewer, W/(sr m^2)
    double uncertainty = 0;  // of the largest component of `reflected`, 95 % confidence, W/(sr m^2)
    glm::dvec3 ambient{0};   // reflected from ambient light, W/(sr m^2); neither includes emission
    // Where it was asked for.
    EnvironmentCosts costs{};
    Surroundings surroundings{};
    Reflected environment{};  // of `reflected`: the environment's part

    glm::dvec3 all() const { return reflected.diffuse + reflected.specular + ambient; }
    Shading& operator+=(const Shading& other) {
        reflected += other.reflected;
        uncertainty += other.uncertainty;
        ambient += other.ambient;
        costs += other.costs;
        surroundings += other.surroundings;
        environment += other.environment;
        return *this;
    }
    friend Shading operator*(const Shading& a, double b) {
        return {a.reflected * b, a.uncertainty * b,  a.ambient * b,
                a.costs * b,     a.surroundings * b, a.environment * b};
    }
};

class Lighting {
public:
    // `lights` are in world space; `environment` must outlive this; `eye` becomes the origin of positions;
    // `ambient` is radiance from all directions; `casters` are the lights, by their places, that cast
    // shadows.
    Lighting(std::span<const Light> lights, const Environment* environment, double environment_factor,
             const glm::dvec3& eye, const glm::dvec3& ambient = glm::dvec3(0),
             std::span<const std::size_t> casters = {}, bool shadowed_environment = false,
             Multiscatter multiscatter = Multiscatter::off, double environment_turned = 0,
             const Falloff& falloff = {});

    // From now on Shading has its costs, unless light between microfacets is followed, or its surroundings,
    // of what `visible` is known.
    void takeCosts();
    void takeSurroundings() { takes_surroundings_ = true; }

    // What is seen where no surface is, W/(sr m^2).
    glm::dvec3 background(const glm::dvec3& direction) const {
        return environment_ ? environment_->radiance(direction) : glm::dvec3(0);
    }

    // `visible`, for what casts shadows; empty: nothing does. `seed` identifies the shaded surface, for
    // sampling.
    Shading operator()(const Surface& surface, const Visibility& visible, std::uint64_t seed) const;

    // What a surface reflects of light from one direction.
    Brdf brdf(const Surface& surface) const { return Brdf(surface, compensationOf(surface, multiscatter_)); }

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
    Shading fromEmitter(const Emitter& emitter, const glm::dvec3& place, const Brdf& brdf,
                        const Visibility& visible, std::uint64_t seed) const;
    // `lobeOnly`: nothing from the base, which has its light from a lightmap.
    Estimated fromEnvironment(const Brdf& brdf, bool lobeOnly, const Visibility& visible,
                              std::uint64_t seed) const;
    // What further reflections between microfacets add, by random walk (microsurface.h), and the share that
    // the base gets of all light: what its layer does not reflect. `single`: the radiance of single
    // reflections, which the confidence is relative to.
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
