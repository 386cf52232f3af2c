// SPDX-License-Identifier: MIT
// What is fitted, and what is fitted to it, in double precision. Directions are unit vectors in the frame of
// shared/contract/ltc.h: z = n, and the viewer in the plane of x and z at x <= 0.
#pragma once

#include "shared/light/ltc.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace diptych::ltc {

// The specular lobe of shaders/lib/brdf.glsl without F: D V (n.l), 1/sr.
class Lobe {
public:
    // alpha: GGX width, roughness^2; n_dot_v in (0, 1].
    Lobe(double alpha, double n_dot_v);

    struct Value {
        double lobe = 0;     // 1/sr; 0 from below the horizon
        double density = 0;  // that sample() draws the direction with, 1/sr
        double schlick = 0;  // (1 - v.h)^5
    };
    Value operator()(const glm::dvec3& l) const;
    // Mirrors at a normal that the viewer sees: Heitz 2018, "Sampling the GGX Distribution of Visible
    // Normals". `u` is in the unit square. The direction may be below the horizon.
    glm::dvec3 sample(const glm::dvec2& u) const;

    double alpha() const { return alpha_; }
    double nDotV() const { return view_.z; }

private:
    double alpha_, lambda_v_;
    glm::dvec3 view_;
};

// The matrix M, and the clamped cosine that it transforms.
struct Transform {
    double a = 1, b = 0, c = 1;

    double density(const glm::dvec3& l) const;  // 1/sr; over the hemisphere it sums to 1
    glm::dvec3 sample(const glm::dvec2& u) const;
};
// What a cell stands for.
Transform transformOf(const LtcCell& cell, double alpha, double n_dot_v);

// Magnitude and Fresnel of a lobe, by n x n directions.
struct Albedo {
    double magnitude = 0, fresnel = 0;
};
Albedo albedoOf(const Lobe& lobe, int n);

// LtcCell::error, by 2 n x n directions: half of them drawn from the lobe, half from the transformed cosine,
// weighted by the balance heuristic (Veach and Guibas 1995).
double distance(const Lobe& lobe, double magnitude, const Transform& transform, int n);

}  // namespace diptych::ltc
