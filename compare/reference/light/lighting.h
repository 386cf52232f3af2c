// SPDX-License-Identifier: MIT
// Evaluates every light at a surface, without culling, packing or light lists.
#pragma once

#include "compare/reference/light/area.h"
#include "compare/reference/light/environment.h"
#include "compare/reference/light/environment_costs.h"
#include "compare/reference/light/punctual.h"
#include "compare/reference/light/surroundings.h"
#include "compare/reference/scattering/adaptive_sampling.h"
#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/multiscatter.h"
#include "compare/reference/scattering/quadrature.h"
#include "compare/reference/scattering/surface.h"
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

// Error of float32 shading against double precision that every pixel may have, relative to its light.
inline constexpr double everywhereRounded = 1e-4;

struct Shading {
    // From lights and environment towards the viewer, W/(sr m^2).
    Reflected reflected;
    double uncertainty = 0;  // 95 % confidence, of the largest component of `reflected`, W/(sr m^2)
    // Ambient light, reflected and from behind, W/(sr m^2); neither includes emission.
    glm::dvec3 ambient{0};
    // Only if requested.
    EnvironmentCosts costs{};
    Surroundings surroundings{};
    Reflected environment{};  // the environment's part of `reflected`
    // Parts of `reflected` and `ambient`: the clear coat's, the sheen's, and that of light from behind.
    glm::dvec3 clearcoat{0}, sheen{0}, from_behind{0};
    // Errors that a path's float32 makes where light grazes, nears its range or meets a sharp lobe. Of
    // diffuse and specular light, clear coat and sheen; largest components, W/(sr m^2).
    glm::dvec4 rounding{0};

    glm::dvec3 all() const { return reflected.sum() + ambient; }
    Shading& operator+=(const Shading& other) {
        reflected += other.reflected;
        uncertainty += other.uncertainty;
        ambient += other.ambient;
        costs += other.costs;
        surroundings += other.surroundings;
        environment += other.environment;
        clearcoat += other.clearcoat;
        sheen += other.sheen;
        from_behind += other.from_behind;
        rounding += other.rounding;
        return *this;
    }
    friend Shading operator*(const Shading& a, double b) {
        return {a.reflected * b,   a.uncertainty * b, a.ambient * b, a.costs * b,       a.surroundings * b,
                a.environment * b, a.clearcoat * b,   a.sheen * b,   a.from_behind * b, a.rounding * b};
    }
};

// Everything that lights a surface.
struct LightingInputs {
    std::span<const Light> lights = {};        // in world space
    const Environment* environment = nullptr;  // must outlive the Lighting
    double environment_factor = 1;
    double environment_rotation = 0;            // about +Y, counter-clockwise seen from above, rad
    glm::dvec3 eye{0};                          // positions become relative to it
    glm::dvec3 ambient{0};                      // uniform radiance, W/(sr m^2)
    std::span<const std::size_t> casters = {};  // indices of shadow-casting `lights`
    bool shadowed_environment = false;
    Multiscatter multiscatter = Multiscatter::off;
    Falloff falloff = {};
};

class Lighting {
public:
    explicit Lighting(const LightingInputs& inputs);

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
    Shading fromEmitter(const Emitter& emitter, const glm::dvec3& point, const Brdf& brdf,
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
    // Punctual lights that reach the surface.
    std::vector<Incident> incidentOn(const Surface& surface, const Visibility& visible) const;
    // Area lights and sun discs above the surface's horizon.
    struct Shining;
    std::vector<Shining> shiningOn(const Surface& surface) const;

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
