// SPDX-License-Identifier: MIT
// What the usual ways to light a surface by an environment are off by, by the reference's own integrals:
// irradiance by spherical harmonics up to order 2 (Ramamoorthi and Hanrahan 2001, "An Efficient
// Representation for Irradiance Environment Maps"), and the split sum (Karis 2013, "Real Shading in Unreal
// Engine 4"): the mean radiance about the mirrored direction times the lobe's own integral.
#pragma once

#include "compare/reference/brdf.h"
#include "compare/reference/environment.h"
#include "shared/frame/setting_values.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace diptych::reference {

// Of one surface, largest components, W/(sr m^2). What is sampled is off by its interval of 99.9 % at most,
// which is added; and what maps of the picture's own resolution cannot hold.
struct EnvironmentCosts {
    // By IblDiffuse: irradiance, with the base's share of all light in the place of that of each direction's;
    // the split sum, and what a Lambertian lobe beside it reflects of that irradiance.
    std::array<double, 3> diffuse{}, split{};
    double sampled = 0;  // in the place of `split`, where the lobe is sampled
    double wider = 0;    // how far the split sum with a lobe of twice the solid angle is from it
    double lobe = 0;     // what the specular lobe sends of the environment

    EnvironmentCosts& operator+=(const EnvironmentCosts& other);
    friend EnvironmentCosts operator*(const EnvironmentCosts& a, double b);
};

class EnvironmentApproximation {
public:
    // `light` must outlive it.
    explicit EnvironmentApproximation(const EnvironmentLight& light);

    // `exact`: what the surface reflects of the environment by the whole BRDF, unoccluded. `seed`: as for
    // Lighting.
    EnvironmentCosts costs(const Surface& surface, const Compensation& compensation, const Reflected& exact,
                           std::uint64_t seed) const;

    // Irradiance over pi of the harmonics, at least 0; W/(sr m^2). `window`: bands l are multiplied by 1 / (1
    // + window l^2 (l + 1)^2) (Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks").
    glm::dvec3 irradiance(const glm::dvec3& normal, double window) const;
    // The least window with which nothing is negative.
    double window() const { return window_; }

private:
    struct Means {
        glm::dvec3 irradiance, mirrored;  // over pi; under the lobe: W/(sr m^2)
        glm::dvec3 wider;                 // under a lobe of twice the solid angle
        double uncertainty;               // 99.9 %
    };
    Means meansOf(const glm::dvec3& normal, const glm::dvec3& mirrored, double alpha,
                  std::uint64_t seed) const;
    glm::dvec3 unclamped(const glm::dvec3& normal, double window) const;
    double range(const glm::dvec3& direction, double reach) const;

    const EnvironmentLight& light_;
    // Integrals over all directions d of the radiance times 1, d and d d^T.
    glm::dvec3 flux_{0};
    std::array<glm::dvec3, 3> vector_{};
    std::array<std::array<glm::dvec3, 3>, 3> tensor_{};
    double window_ = 0, peak_ = 0;  // of irradiance over pi: the largest component
    double cell_;                   // how far apart what a map of the picture's resolution mixes may be, rad
};

}  // namespace diptych::reference
