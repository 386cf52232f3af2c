// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shading/brdf.glsl"
#include "tests/probe/shaders/probe.glsl"

// v, l (unit, n = +Z), roughness, metallic, albedo, F0, F90 -> diffuse, specular radiance for 1 W/m^2
// (red)
void main() {
    if (PROBE_ROW >= probe_rows) return;
    Surface s;
    s.normal = vec3(0.0, 0.0, 1.0);
    s.roughness = IN(11, 6);
    s.metallic = IN(11, 7);
    s.albedo = vec3(IN(11, 8));
    s.dielectric_f0 = vec3(IN(11, 9));
    s.dielectric_f90 = IN(11, 10);
    s.transmission = 0.25;  // read only with feature_transmission
    vec3 v = IN3(11, 0), l = IN3(11, 3);
    Lobes reflected = lobesUnder(makeBrdf(s, v), s.normal, v, Incident(l, vec3(1.0)));
    OUT(2, 0) = reflected.diffuse.r;
    OUT(2, 1) = reflected.specular.r;
}
