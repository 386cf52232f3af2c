// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "tests/probe/shaders/probe.glsl"

// receiver: texel, normal, depth; depth per texel; direction across the blockers' edges; nearest texel and
// depth of a blocker that has no end, and of one on the other side; the light's tangent and widest filter
// -> visibility; for feature_shadow_kernel
const uint WIDTH = 15;

// Takes the place of the shadow map: the blockers' depths in textureGather's order.
const int MAP_SIZE = 256;
float storedAt(const vec2 texel) {
    vec2 offset = texel - vec2(IN(WIDTH, 0), IN(WIDTH, 1));
    float beside = dot(offset, vec2(IN(WIDTH, 7), IN(WIDTH, 8)));
    return beside > IN(WIDTH, 9) ? IN(WIDTH, 10) : beside < -IN(WIDTH, 11) ? IN(WIDTH, 12) : 0.0;
}
vec4 storedAround(const vec3 point) {
    vec2 corner = round(point.xy * float(MAP_SIZE)) - 1.0;
    return vec4(storedAt(corner + vec2(0.5, 1.5)), storedAt(corner + vec2(1.5, 1.5)),
                storedAt(corner + vec2(1.5, 0.5)), storedAt(corner + vec2(0.5, 0.5)));
}
#define textureGather(map, point) storedAround(point)
#define textureSize(map, level) ivec3(MAP_SIZE)
#include "shaders/lib/shadows/sun_shadow.glsl"

void main() {
    if (PROBE_ROW >= probe_rows) return;
    Surface s;
    s.position = vec3(IN(WIDTH, 0), IN(WIDTH, 1), 0.0);
    s.geometric_normal = IN3(WIDTH, 2);
    ShadowLight light;
    light.x = vec3(1.0, 0.0, 0.0);
    light.y = vec3(0.0, 1.0, 0.0);
    light.to_light = vec3(0.0, 0.0, 1.0);
    light.depth_offset = IN(WIDTH, 5);
    light.depth_scale = IN(WIDTH, 6);
    light.rounding = 0.0;
    light.disc = IN(WIDTH, 13);
    light.widest = IN(WIDTH, 14);
    Cascade cascade;  // texels of 1 m
    cascade.texels_per_metre = 1.0;
    cascade.offset = vec2(0.0);
    cascade.bias = 0.0;
    ReceiverPlane r = sunReceiverPlane(s, light, cascade, MAX_PLANE_BIAS);
    OUT(1, 0) = pcssVisibility(s, light, cascade, r, 0u);
}
