// SPDX-License-Identifier: MIT
// Sampling until a stated confidence.
#pragma once

#include "compare/reference/surface.h"

#include <glm/vec2.hpp>

#include <cstdint>

namespace diptych::reference {

// Numbers in [0, 1) that are the same for the same seed: every pixel, light and round has its own, so that a
// picture does not depend on the number of threads or on where it was taken up again. (Steele, Lea and Flood
// 2014, "Fast Splittable Pseudorandom Number Generators": SplitMix64.)
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double operator()();

private:
    std::uint64_t state_;
};

// The seed of one of many streams under a seed; no two are the same but by chance.
std::uint64_t streamOf(std::uint64_t seed, std::uint64_t number);

// Point `index` of the R2 sequence (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"),
// turned by `shift` on the torus (Cranley and Patterson 1976): any run of indices covers the square evenly.
glm::dvec2 evenly(std::uint64_t index, const glm::dvec2& shift);

// Rounds that are independent and estimate the same: their mean, and how far it is from the truth with a
// confidence of 95 %, by Student's distribution.
class Rounds {
public:
    void add(const Reflected& estimate);
    Reflected mean() const { return mean_; }
    double halfWidth() const;  // of mean().size(), W/(sr m^2); infinite below two rounds

private:
    std::uint32_t count_ = 0;
    Reflected mean_;
    glm::dvec3 squares_{0};  // sum of squared deviations of the two lobes' sum (Welford 1962)
};

}  // namespace diptych::reference
