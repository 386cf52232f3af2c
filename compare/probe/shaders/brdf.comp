// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shading/brdf.glsl"
#include "compare/probe/shaders/rows.glsl"

// alpha, n, s -> D
void distribution() {
    float alpha = in1(0);
    vec3 n = in3(1), s = in3(4);
    float k = alpha * dot(s, s) / ggxDenominator(alpha * alpha, n, s);
    out1(0, k * k * INVERSE_PI);
}

Surface surfaceOf(const uint i) {
    Surface s;
    s.roughness = in1(i);
    s.normal = in3(i + 1);
    s.metallic = 0.0;
    s.albedo = vec3(0.0);
    s.dielectric_f0 = vec3(0.0);
    s.dielectric_f90 = 1.0;
    return s;
}

float lobeOf(const Surface s, const vec3 v, const vec3 l) {
    vec3 sum = l + v;
    return specularLobe(makeBrdf(s, v), s.normal, sum, dot(sum, sum), clamp(dot(s.normal, l), 0.0, 1.0));
}

// roughness, n, v, l -> the lobe; second output with v and l exchanged
void lobes() {
    Surface s = surfaceOf(0);
    out1(0, lobeOf(s, in3(4), in3(7)));
    if (outs > 1) out1(1, lobeOf(s, in3(7), in3(4)));
}

// roughness, n, v, l, metallic, albedo, F0, F90 -> diffuse and specular radiance for 1 W/m^2
void light() {
    Surface s = surfaceOf(0);
    s.metallic = in1(10);
    s.albedo = vec3(in1(11));
    s.dielectric_f0 = vec3(in1(12));
    s.dielectric_f90 = in1(13);
    vec3 v = in3(4);
    Lobes reflected = lobesUnder(makeBrdf(s, v), s.normal, v, Incident(in3(7), vec3(1.0)));
    out1(0, reflected.diffuse.r);
    out1(1, reflected.specular.r);
}

void main() {
    if (beyondRows()) return;
    switch (probed) {
        case 0: distribution(); break;
        case 1: lobes(); break;
        case 2: out1(0, schlickWeight(in1(0))); break;
        case 3: light(); break;
    }
}
