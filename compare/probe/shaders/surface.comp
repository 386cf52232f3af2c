// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shading/multiscatter.glsl"
#include "shaders/lib/surface/specular_aa.glsl"
#include "compare/probe/shaders/rows.glsl"

void main() {
    if (beyondRows()) return;
    switch (probed) {
        case 0:  // roughness, change of the normal in x and y, part of it due to rounding, limit
            out1(0, filteredRoughness(in1(0), in3(1), in3(4), in1(7), in1(8)));
            break;
        case 1: {  // F0, F90, albedo -> factors of both, Lambertian lobe
            SpecularFactors s = specularFactors(vec3(in1(0)), in1(1), vec2(in1(2), in1(3)));
            out1(0, s.f0.x);
            out1(1, s.f90.x);
            out1(2, s.between.x);
            break;
        }
        case 2: out1(0, meanSchlickWeight(in1(0))); break;
        case 3: out3(0, unitVector(in3(0))); break;
    }
}
