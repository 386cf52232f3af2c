// SPDX-License-Identifier: MIT
// Combines the samples of a pixel: the mean of their radiance, linear or weighted by a tone curve. The
// weights keep a few bright samples from dominating a pixel at a light's edge (Karis 2014, "High Quality
// Temporal Supersampling").
#pragma once

#include "compare/reference/pixel.h"
#include "shared/frame/setting_values.h"

#include <glm/vec3.hpp>

namespace diptych::reference {

// The weight of a sample with this radiance, W/(sr m^2): 1, or 1 / (1 + its largest component). Negative
// components count as 0.
double resolveWeight(Resolve resolve, const glm::dvec3& radiance);

// Adds up to `samples` samples, in a fixed order.
class ResolvedLight {
public:
    ResolvedLight(Resolve resolve, int samples) : resolve_(resolve), fraction_(1.0 / samples) {}

    void add(const Pixel& sample);
    // Writes the light of all samples to `pixel`: lit, its parts, and their errors.
    void put(Pixel& pixel) const;

private:
    Resolve resolve_;
    double fraction_;
    Pixel sum_;                                   // light times weight times fraction_
    double weights_ = 0, unblended_weights_ = 0;  // times fraction_
    Shading errors_, blended_errors_;             // propagated sample errors, if tonemapped
};

}  // namespace diptych::reference
