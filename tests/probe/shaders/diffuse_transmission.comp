// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/shading/diffuse_transmission.glsl"
#include "shaders/lib/shading/ambient.glsl"
#include "tests/probe/shaders/probe.glsl"

// v, l (unit), n, weight and colour of diffuse transmission, albedo, metallic, F0, F90 -> diffuse radiance
// for 1 W/m^2, that through the surface, and that of uniform radiance 1 from behind (red)
const uint WIDTH = 15;

void main() {
    if (PROBE_ROW >= probe_rows) return;
    Surface s = bareSurface(vec3(0.0));
    vec3 v = IN3(WIDTH, 0), l = IN3(WIDTH, 3);
    s.normal = IN3(WIDTH, 6);
    s.diffuse_transmission = IN(WIDTH, 9);
    s.diffuse_transmission_color = vec3(IN(WIDTH, 10));
    s.albedo = vec3(IN(WIDTH, 11));
    s.metallic = IN(WIDTH, 12);
    s.roughness = 0.5;
    s.dielectric_f0 = vec3(IN(WIDTH, 13));
    s.dielectric_f90 = IN(WIDTH, 14);
    Brdf b = makeBrdf(s, v);
    Lobes reflected = lobesUnder(b, s.normal, v, Incident(l, vec3(1.0)));
    Reflector behind = makeBehind(b, s.normal, v);
    OUT(3, 0) = reflected.diffuse.r;
    OUT(3, 1) = lobesUnder(behind.brdf, behind.n, behind.v, Incident(l, vec3(1.0))).diffuse.r;
    OUT(3, 2) = fromBase(behind).r;
}
