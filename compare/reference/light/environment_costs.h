// SPDX-License-Identifier: MIT
// Errors of the usual approximations of environment lighting, measured by the reference's own integrals.
// The approximations are irradiance by spherical harmonics up to order 2 (Ramamoorthi and Hanrahan 2001,
// "An Efficient Representation for Irradiance Environment Maps") and the split sum (Karis 2013, "Real
// Shading in Unreal Engine 4"). The split sum is the mean radiance about the mirror direction times the
// lobe's own integral. A sheen is lit by irradiance in its place.
#pragma once

#include "compare/reference/light/environment.h"
#include "compare/reference/scattering/brdf.h"
#include "shared/frame/setting_values.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace diptych::reference {

// Errors at one surface, largest components, W/(sr m^2). Each includes the 99.9 % confidence interval of
// sampled values, and the error of maps with the environment's own resolution.
struct EnvironmentCosts {
    // By IblDiffuse. `diffuse`: irradiance times the base's albedo under uniform light, on each side that
    // light passes. `split`: the split
    // sum, with the Lambertian lobe of multiple scattering lit by that irradiance, or the sheen.
    std::array<double, 3> diffuse{}, split{};
    double sampled = 0;  // replaces `split` where the lobe is sampled; a sheen is not
    double wider = 0;    // change of the split sum for a lobe of twice the solid angle
    double lobe = 0;     // radiance that the specular lobe reflects from the environment

    EnvironmentCosts& operator+=(const EnvironmentCosts& other);
    friend EnvironmentCosts operator*(const EnvironmentCosts& a, double b);
};

class EnvironmentApproximation {
public:
    // `light` must outlive it.
    explicit EnvironmentApproximation(const EnvironmentLight& light);

    // Errors for one layer. `exact`: the environment's light reflected by the whole BRDF, unoccluded. `seed`:
    // as for Lighting.
    EnvironmentCosts costs(const Surface& surface, const Compensation& compensation, const Reflected& exact,
                           std::uint64_t seed) const;

    // Irradiance / pi from the harmonics, at least 0, W/(sr m^2). Band l is multiplied by 1 / (1 + window
    // l^2 (l + 1)^2) (Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks").
    glm::dvec3 irradiance(const glm::dvec3& normal, double window) const;
    // The smallest window at which no irradiance is negative.
    double window() const { return window_; }

private:
    struct Means {
        glm::dvec3 irradiance, mirrored;  // irradiance / pi; mean radiance under the lobe, W/(sr m^2)
        glm::dvec3 wider;                 // under a lobe of twice the solid angle
        double uncertainty;               // 99.9 % confidence
    };
    Means meansOf(const glm::dvec3& normal, const glm::dvec3& mirrored, double alpha,
                  std::uint64_t seed) const;
    // The paths' irradiance / pi, and how far a path's own value may be from it.
    struct Taken {
        glm::dvec3 irradiance;
        double open;
    };
    Taken takenAs(IblDiffuse kind, const glm::dvec3& normal, const Means& means) const;
    EnvironmentCosts sheenCosts(const Surface& sheen, const glm::dvec3& exact, std::uint64_t seed) const;
    glm::dvec3 unclamped(const glm::dvec3& normal, double window) const;
    double range(const glm::dvec3& direction, double reach) const;

    const EnvironmentLight& light_;
    // Integrals over all directions d of the radiance times 1, d and d d^T.
    glm::dvec3 flux_{0};
    std::array<glm::dvec3, 3> vector_{};
    std::array<std::array<glm::dvec3, 3>, 3> tensor_{};
    double window_ = 0, peak_ = 0;  // peak_: largest component of irradiance / pi
    // largest angle between directions that a map of the environment's resolution mixes, rad
    double cell_;
};

}  // namespace diptych::reference
