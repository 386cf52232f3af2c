// SPDX-License-Identifier: MIT
// The fitted lobe and the transformed cosine that approximates it, in double precision. Directions are
// unit vectors in the frame of shared/contract/ltc.h: z = n, and the viewer in the plane of x and z at x
// <= 0.
#pragma once

#include "shared/light/ltc.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace diptych::ltc {

// The specular lobe of shaders/lib/shading/brdf.glsl: D V F (n.l), 1/sr, with Schlick's F from f0 to 1.
class Lobe {
public:
    // alpha: GGX width, roughness^2; n_dot_v in (0, 1].
    Lobe(double alpha, double n_dot_v, double f0 = 1);

    struct Value {
        double lobe = 0;     // 1/sr; 0 below the horizon
        double density = 0;  // of sample() for this direction, 1/sr
        double schlick = 0;  // (1 - v.h)^5
    };
    Value operator()(const glm::dvec3& l) const;
    // Reflects at a visible normal: Heitz 2018, "Sampling the GGX Distribution of Visible Normals". `u` is
    // in the unit square. The direction may be below the horizon.
    glm::dvec3 sample(const glm::dvec2& u) const;

    double alpha() const { return alpha_; }
    double nDotV() const { return view_.z; }

private:
    double alpha_, f0_, lambda_v_;
    glm::dvec3 view_;
};

// The matrix M, and the tilted clamped cosine that it transforms.
struct Transform {
    double a = 1, b = 0, c = 1, tilt = 0;

    glm::dvec3 toCosine(const glm::dvec3& l) const { return {(l.x - b * l.z) / a, l.y / c, l.z}; }
    glm::dvec3 fromCosine(const glm::dvec3& p) const { return {a * p.x + b * p.z, c * p.y, p.z}; }
    // 1/sr; both integrate to 1 over the hemisphere. `upright`: without the tilt, so never negative.
    double density(const glm::dvec3& l) const;
    double upright(const glm::dvec3& l) const;
    glm::dvec3 sample(const glm::dvec2& u) const;  // with density upright()
};
// Transform of a cell's lobe.
Transform transformOf(const LtcLobe& lobe, double alpha, double n_dot_v);

// Magnitude and Fresnel of a lobe with F = 1, from n x n directions.
struct Albedo {
    double magnitude = 0, fresnel = 0;
};
Albedo albedoOf(const Lobe& lobe, int n);

// LtcLobe::error from 2 n x n directions: half sampled from the lobe, half from the transformed cosine,
// weighted by the balance heuristic (Veach and Guibas 1995). `all`: integral of the lobe.
double distance(const Lobe& lobe, double all, const Transform& transform, int n);

}  // namespace diptych::ltc
