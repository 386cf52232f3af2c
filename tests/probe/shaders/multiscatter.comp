// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shading/multiscatter.glsl"
#include "tests/probe/shaders/probe.glsl"

// v, l (unit, n = +Z), roughness, metallic, albedo, F0, F90, specularAlbedo() -> diffuse, specular
// radiance for 1 W/m^2 (red), both for uniform radiance 1
const uint WIDTH = 13;

void main() {
    if (PROBE_ROW >= probe_rows) return;
    Surface s;
    s.normal = vec3(0.0, 0.0, 1.0);
    s.roughness = IN(WIDTH, 6);
    s.metallic = IN(WIDTH, 7);
    s.albedo = vec3(IN(WIDTH, 8));
    s.dielectric_f0 = vec3(IN(WIDTH, 9));
    s.dielectric_f90 = IN(WIDTH, 10);
    vec3 v = IN3(WIDTH, 0), l = IN3(WIDTH, 3);
    vec2 table = vec2(IN(WIDTH, 11), IN(WIDTH, 12));
    Brdf b = compensated(makeBrdf(s, v), s, table);
    Lobes reflected = lobesUnder(b, s.normal, v, Incident(l, vec3(1.0)));
    OUT(4, 0) = reflected.diffuse.r;
    OUT(4, 1) = reflected.specular.r;
    OUT(4, 2) = b.diffuse.r * PI * (1.0 - b.base_f0.r);
    OUT(4, 3) = b.f0.r * table.x + b.f90.r * table.y + b.between.r * PI;
}
