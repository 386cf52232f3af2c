// SPDX-License-Identifier: MIT
// Random numbers and confidence intervals.
#pragma once

#include "compare/reference/scattering/surface.h"

#include <glm/vec2.hpp>

#include <cstdint>

namespace diptych::reference {

// Pseudorandom numbers in [0, 1), determined by the seed. Every pixel, light and round has its own seed,
// so an image does not depend on the number of threads or on interruptions. (SplitMix64: Steele, Lea and
// Flood 2014, "Fast Splittable Pseudorandom Number Generators".)
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double operator()();

private:
    std::uint64_t state_;
};

// The seed of stream `index` under `seed`; two streams are equal only by chance.
std::uint64_t streamOf(std::uint64_t seed, std::uint64_t index);

// Point `index` of the R2 sequence (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom
// Sequences"), shifted by `shift` on the torus (Cranley and Patterson 1976). Every range of consecutive
// indices covers the square evenly.
glm::dvec2 evenly(std::uint64_t index, const glm::dvec2& shift);

// Factor from the half-width at 95 % confidence, which the reference reports, to 99.9 %: Student's t with
// 7 degrees of freedom, 5.41 / 2.36.
inline constexpr double surerThan95 = 2.29;

// Independent estimates of one value: their mean, and its 95 % confidence interval by Student's t.
class Rounds {
public:
    void add(const Reflected& estimate);
    Reflected mean() const { return mean_; }
    double halfWidth() const;  // of mean().size(), W/(sr m^2); infinite below two estimates

private:
    std::uint32_t count_ = 0;
    Reflected mean_;
    glm::dvec3 squares_{0};  // sums of squared deviations (Welford 1962) of the sum of all lobes
};

}  // namespace diptych::reference
