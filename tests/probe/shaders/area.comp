// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/lights/area.glsl"
#include "shaders/lib/shading/multiscatter.glsl"
#include "tests/probe/shaders/probe.glsl"

// kind (its number in AREA_KINDS), centre from the surface, x, radius, y, extent, direction, two_sided, 1 /
// range^2; v (n = +Z), roughness, metallic, albedo, F0, F90; the table's cell: even, layer, magnitude,
// Fresnel -> diffuse, specular radiance for a light of radiance 1
const uint WIDTH = 35;

void main() {
    if (PROBE_ROW >= probe_rows) return;
    Light light;
    light.position = IN3(WIDTH, 1);
    light.intensity = vec3(1.0);
    AreaLight shape;
    shape.x = IN3(WIDTH, 4);
    shape.radius = IN(WIDTH, 7);
    shape.y = IN3(WIDTH, 8);
    shape.extent = IN(WIDTH, 11);
    shape.direction = IN3(WIDTH, 12);
    shape.two_sided = IN(WIDTH, 15);
    light.inverse_range_squared = IN(WIDTH, 16);

    Surface s;
    s.normal = vec3(0.0, 0.0, 1.0);
    vec3 v = IN3(WIDTH, 17);
    s.roughness = IN(WIDTH, 20);
    s.metallic = IN(WIDTH, 21);
    s.albedo = vec3(IN(WIDTH, 22));
    s.dielectric_f0 = vec3(IN(WIDTH, 23));
    s.dielectric_f90 = IN(WIDTH, 24);
    Brdf b = makeBrdf(s, v);
    LtcCell cell;
    cell.even = vec4(IN3(WIDTH, 25), IN(WIDTH, 28));
    cell.layer = vec4(IN3(WIDTH, 29), IN(WIDTH, 32));
    cell.magnitude = IN(WIDTH, 33), cell.fresnel = IN(WIDTH, 34);
    if (on(feature_multiscatter)) b = compensated(b, s, vec2(cell.magnitude - cell.fresnel, cell.fresnel));
    AreaView a = areaViewOf(b, s.normal, v, cell);

    AreaLobes lobes;
    uint kind = uint(IN(WIDTH, 0));
#define SHADE(number, name, cost) if (kind == number) lobes = name##Lobes(a, light, shape, vec3(0.0));
    AREA_KINDS(SHADE)
    OUT(2, 0) = lobes.lobes.diffuse.r;
    OUT(2, 1) = lobes.lobes.specular.r;
}
