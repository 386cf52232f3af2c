// SPDX-License-Identifier: MIT
// One light of the samples of a pixel: the mean of their radiance, or weighted by what a tone curve leaves of
// each (Karis 2014, "High Quality Temporal Supersampling"), so that a few samples of a lamp do not decide a
// pixel of its edge alone.
#pragma once

#include "compare/reference/pixel.h"
#include "shared/frame/setting_values.h"

#include <glm/vec3.hpp>

namespace diptych::reference {

// What a sample of this radiance, W/(sr m^2), counts: 1, or 1 / (1 + its largest component), of which what is
// negative is 0.
double resolveWeight(Resolve resolve, const glm::dvec3& radiance);

// Samples are added in any number up to the one that it is told, in one order.
class ResolvedLight {
public:
    ResolvedLight(Resolve resolve, int samples) : resolve_(resolve), share_(1.0 / samples) {}

    void add(const Pixel& sample);
    // Gives `pixel` the light of all samples: lit, its parts, and what is known of their error.
    void put(Pixel& pixel) const;

private:
    Resolve resolve_;
    double share_;
    Pixel sum_;                                   // of light times weight times share
    double weights_ = 0, unblended_weights_ = 0;  // times share
    Shading errors_, blended_errors_;             // sums that errors of samples make, if tonemapped
};

}  // namespace diptych::reference
